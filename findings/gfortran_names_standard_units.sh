#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# gfortran 12.2: INQUIRE asks units 5 and 6, which are connected before the program begins, and standard output goes to a file, for their names.
# Expected: NAMED is false, as of a scratch file, for a program opens no file with a name here.
# Seen: NAMED is true, and the names are stdin and stdout; no such file exists. A law of Abaqus that names its files after that of unit 6 (there job.dat) writes stdout-1.txt into the folder of the run.
. "$(dirname "$(realpath "$0")")/packages.inc"
take gfortran-12=12.2.0-14+deb12u1
cat > names.f90 <<'SOURCE'
program names
   character(len=20) :: name
   logical :: named, exists
   integer :: n
   open(unit=10, status='scratch')
   do n = 5, 10
      if (n > 6 .and. n < 10) cycle
      name = '-'
      inquire(unit=n, named=named, name=name)
      inquire(file=name, exist=exists)
      write(0, '(i0, 1x, l1, 1x, a, 1x, l1)') n, named, trim(name), exists
   end do
end program names
SOURCE
gfortran-12 -fno-use-linker-plugin -B/usr/lib/gcc/x86_64-linux-gnu/12/ -o names names.f90
./names > out.txt 2> found.txt
echo 'unit, named, its name, whether such a file exists:'
cat found.txt
printf '5 T stdin F\n6 T stdout F\n10 F - F\n' | cmp -s - found.txt || changed 'the standard units have other names'
