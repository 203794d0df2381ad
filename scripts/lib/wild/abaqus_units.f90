! SPDX-License-Identifier: GPL-2.0-or-later
! Unit 6, which in Abaqus is a file with a name, for laws of scripts/wild that ask for that name. utilities.cpp opens it as the library is loaded.
subroutine open_units() bind(C, name='open_units')
   implicit none
   open(unit=6, file='law.dat', status='unknown')
end subroutine open_units
