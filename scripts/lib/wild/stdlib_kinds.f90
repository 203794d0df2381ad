! SPDX-License-Identifier: GPL-2.0-or-later
! Stand-in for the kinds of Fortran's stdlib, for laws of scripts/wild that use nothing else of it.
module stdlib_kinds
   use, intrinsic :: iso_fortran_env, only: sp => real32, dp => real64
   implicit none
end module stdlib_kinds
