#!/bin/sh
# Prints an assembler file that contains files as they are: `sh scripts/embed.sh FORMAT ALIGN NAME FILE...`. The bytes of
# a file begin at NAME, a multiple of ALIGN, and end at NAME_end; a 0 follows. A file that is absent is empty. The
# section vs_files is their own, so that the constants that a start reads lie together. FORMAT: elf or wasm.
set -eu
format=$1 align=$2
shift 2
case $format in
  elf) echo '.section vs_files,"a"' ;;
  wasm) echo '.section .rodata.vs_files,"",@' ;;
  *) echo "embed.sh: the format must be elf or wasm, got $format" >&2; exit 2 ;;
esac
while [ $# -gt 0 ]; do
  printf '.balign %s\n.globl %s\n.hidden %s\n.type %s,@object\n%s:\n' "$align" "$1" "$1" "$1" "$1"
  size=0
  if [ -f "$2" ]; then
    echo ".incbin \"$2\""
    size=$(wc -c < "$2")
  fi
  printf '.globl %s_end\n.hidden %s_end\n.type %s_end,@object\n%s_end:\n.byte 0\n' "$1" "$1" "$1" "$1"
  printf '.size %s,%d\n.size %s_end,1\n' "$1" "$size" "$1"
  shift 2
done
if [ "$format" = elf ]; then echo '.section .note.GNU-stack,"",@progbits'; fi
