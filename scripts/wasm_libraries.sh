#!/bin/sh
# Compiles to WebAssembly the libraries that the playground links: `sh scripts/wasm_libraries.sh DIR` leaves their
# archives in DIR/lib and their headers in DIR/include. The sources are Debian's source packages, of the release and
# from the mirror that this machine's apt uses; apt reads a source list of its own, so that the machine's stays as it is.
set -eu
dir=$(mkdir -p "$1" && cd "$1" && pwd)
cd "$(dirname "$0")/.."
here=$(pwd)
export NODE_PATH="/usr/share/nodejs${NODE_PATH:+:$NODE_PATH}" # Debian's emscripten needs its node packages; another node does not look there
jobs=$(nproc)
mkdir -p "$dir/lib" "$dir/include" "$dir/objects" "$dir/apt/lists/partial" "$dir/apt/archives/partial" "$dir/sources"

# ---- the sources ----

apt_get() { APT_CONFIG=$dir/apt/apt.conf apt-get -q "$@" > "$dir/apt/log" 2>&1; }
# lists COUNT: writes the source list, of all archives of this machine (0), or of the one with this number.
lists() {
  apt-get indextargets --format 'deb-src $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
    awk '$4 == "main"' | sort -u | awk -v n="$1" 'n == 0 || NR == n' > "$dir/apt/sources.list"
  printf 'Dir::Etc::sourcelist "%s";\nDir::Etc::sourceparts "/dev/null";\nDir::State::lists "%s";\nDir::Cache "%s";\n' \
    "$dir/apt/sources.list" "$dir/apt/lists" "$dir/apt" > "$dir/apt/apt.conf"
  [ -s "$dir/apt/sources.list" ] && apt_get update
}
unpack() {
  rm -rf "$dir/unpacked"
  mkdir "$dir/unpacked"
  (cd "$dir/unpacked" && apt_get --download-only source "$1" && dpkg-source --no-check -x ./*.dsc source > "$dir/apt/unpack.log" 2>&1)
}
# fetch PACKAGE: unpacks its source, with Debian's patches, as DIR/sources/PACKAGE. An archive may lack a file that its
# index names; then the other archives are asked.
fetch() {
  [ -d "$dir/sources/$1" ] && return
  echo "  fetch $1"
  archive=0
  until lists $archive && unpack "$1"; do
    archive=$((archive + 1))
    if [ $archive -gt 9 ]; then
      echo "the source package $1 could not be fetched:" >&2
      tail -n 3 "$dir/apt/log" >&2
      exit 1
    fi
  done
  mv "$dir/unpacked/source" "$dir/sources/$1"
  rm -rf "$dir/unpacked"
}

# ---- compiling ----

# compile NAME COMPILER FLAGS...: makes lib/NAME.a of the files that standard input names. Each file's own flags may
# follow its name, after a blank.
compile() {
  name=$1 compiler=$2
  shift 2
  echo "  wasm  lib$name.a"
  mkdir -p "$dir/objects/$name"
  n=0
  rm -f "$dir/objects/$name.new"
  while read -r file flags; do
    n=$((n + 1))
    object=$dir/objects/$name/$n-$(basename "$file").o
    [ -f "$object" ] || echo "$compiler -O2 -w $* $flags -c $file -o $object.new && mv $object.new $object"
    echo "$object" >> "$dir/objects/$name.new"
  done > "$dir/objects/$name.commands"
  tr '\n' '\0' < "$dir/objects/$name.commands" | xargs -0 -r -n 1 -P "$jobs" sh -c
  rm -f "$dir/lib/lib$name.a"
  xargs emar rcs "$dir/lib/lib$name.a" < "$dir/objects/$name.new"
  rm -f "$dir/objects/$name.new"
}
ready() { [ -f "$dir/lib/lib$1.a" ]; }

# GMP for 64-bit limbs, in C alone. Its tables are made by its own programs, which run on this machine.
build_gmp() {
  s=$dir/sources/gmp o=$dir/objects/gmp-made
  mkdir -p "$o"
  sed -e 's/@GMP_LIMB_BITS@/64/; s/@GMP_NAIL_BITS@/0/; s/@DEFN_LONG_LONG_LIMB@/#define _LONG_LONG_LIMB 1/' \
    -e 's/@[A-Za-z_]*@/0/; s/"0"/""/' "$s/gmp-h.in" > "$o/gmp.h"
  cp "$o/gmp.h" "$dir/include/"
  cat > "$o/config.h" <<'CONFIG'
#define HAVE_ALLOCA 1
#define HAVE_ALLOCA_H 1
#define HAVE_ATTRIBUTE_CONST 1
#define HAVE_ATTRIBUTE_MALLOC 1
#define HAVE_ATTRIBUTE_MODE 1
#define HAVE_ATTRIBUTE_NORETURN 1
#define HAVE_DOUBLE_IEEE_LITTLE_ENDIAN 1
#define HAVE_HIDDEN_ALIAS 0
#define HAVE_INTMAX_T 1
#define HAVE_INTTYPES_H 1
#define HAVE_LIMB_LITTLE_ENDIAN 1
#define HAVE_LONG_LONG 1
#define HAVE_MEMSET 1
#define HAVE_STDINT_H 1
#define NO_ASM 1
#define SIZEOF_MP_LIMB_T 8
#define SIZEOF_UNSIGNED 4
#define SIZEOF_UNSIGNED_LONG 4
#define SIZEOF_UNSIGNED_SHORT 2
#define SIZEOF_VOID_P 4
#define STDC_HEADERS 1
#define TUNE_SQR_TOOM2_MAX SQR_TOOM2_MAX_GENERIC
#define VERSION "6"
#define WANT_FFT 1
#define WANT_TMP_ALLOCA 1
CONFIG
  cp "$s/mpn/generic/gmp-mparam.h" "$o/"
  for made in "fac fac_table.h 64 0" "fib fib_table.h header 64 0" "fib fib_table.c table 64 0" "bases mp_bases.h header 64 0" \
    "bases mp_bases.c table 64 0" "trialdivtab trialdivtab.h 64 8000" "jacobitab jacobitab.h" "psqr perfsqr.h 64 0"; do
    set -- $made
    program=$1 file=$2
    shift 2
    [ -x "$o/gen-$program" ] || cc -w -O1 -I"$s" "$s/gen-$program.c" -o "$o/gen-$program" -lm
    "$o/gen-$program" "$@" > "$o/$file"
  done
  {
    for f in "$s"/mpn/generic/*.c; do
      base=$(basename "$f" .c)
      case $base in
        logops_n) for op in and andn nand ior iorn nior xor xnor; do echo "$f -DOPERATION_${op}_n"; done ;;
        popham) echo "$f -DOPERATION_popcount"; echo "$f -DOPERATION_hamdist" ;;
        sec_* | udiv_w_sdiv | add_n_sub_n) ;;
        *) echo "$f -DOPERATION_$base" ;;
      esac
    done
    for f in assert errno invalid memory mp_bpl mp_clz_tab mp_dv_tab mp_minv_tab mp_get_fns mp_set_fns tal-reent version; do echo "$s/$f.c"; done
    echo "$o/fib_table.c"
    echo "$o/mp_bases.c"
  } | compile gmp emcc -DHAVE_CONFIG_H -D__GMP_WITHIN_GMP -I"$o" -I"$s"
}

build_utf8proc() {
  s=$dir/sources/utf8proc
  cp "$s/utf8proc.h" "$dir/include/"
  echo "$s/utf8proc.c" | compile utf8proc emcc -DUTF8PROC_STATIC
}

build_z() {
  s=$dir/sources/zlib
  cp "$s/zlib.h" "$s/zconf.h" "$dir/include/"
  for f in adler32 compress crc32 deflate inffast inflate inftrees trees uncompr zutil; do echo "$s/$f.c"; done | compile z emcc
}

build_png() {
  s=$dir/sources/libpng1.6
  cp "$s/scripts/pnglibconf.h.prebuilt" "$dir/include/pnglibconf.h"
  cp "$s/png.h" "$s/pngconf.h" "$dir/include/"
  for f in png pngerror pngget pngmem pngpread pngread pngrio pngrtran pngrutil pngset pngtrans pngwio pngwrite pngwtran pngwutil; do
    echo "$s/$f.c"
  done | compile png emcc -I"$dir/include" $jumps
}

build_jansson() {
  s=$dir/sources/jansson
  sed -e 's/@json_inline@/inline/; s/@json_have_long_long@/1/; s/@json_have_localeconv@/1/' \
    -e 's/@json_have_atomic_builtins@/0/; s/@json_have_sync_builtins@/0/' "$s/src/jansson_config.h.in" > "$dir/include/jansson_config.h"
  cp "$s/src/jansson.h" "$dir/include/"
  mkdir -p "$dir/objects/jansson-made"
  printf '#define HAVE_STDINT_H 1\n#define HAVE_LOCALE_H 1\n#define HAVE_LOCALECONV 1\n#define INITIAL_HASHTABLE_ORDER 3\n' \
    > "$dir/objects/jansson-made/jansson_private_config.h"
  for f in dump error hashtable hashtable_seed load memory pack_unpack strbuffer strconv utf value version; do echo "$s/src/$f.c"; done |
    compile jansson emcc -I"$dir/include" -I"$dir/objects/jansson-made" -DHAVE_CONFIG_H
}

build_expat() {
  s=$dir/sources/expat
  [ -d "$s/expat" ] && s=$s/expat
  cp "$s/lib/expat.h" "$s/lib/expat_external.h" "$dir/include/"
  mkdir -p "$dir/objects/expat-made"
  printf '#define %s\n' 'HAVE_MEMMOVE 1' 'XML_POOR_ENTROPY 1' 'XML_NS 1' 'XML_DTD 1' 'XML_CONTEXT_BYTES 1024' 'BYTEORDER 1234' \
    > "$dir/objects/expat-made/expat_config.h"
  for f in xmlparse xmlrole xmltok; do echo "$s/lib/$f.c"; done | compile expat emcc -I"$dir/objects/expat-made"
}

build_freetype() {
  s=$dir/sources/freetype o=$dir/objects/freetype-made
  mkdir -p "$o/freetype/config"
  cp -r "$s/include/freetype" "$s/include/ft2build.h" "$dir/include/"
  for m in autofit tt_driver t1_driver cff_driver t1cid_driver psaux_module psnames_module pshinter_module sfnt_module; do
    case $m in
      autofit) echo "FT_USE_MODULE( FT_Module_Class, autofit_module_class )" ;;
      *_driver) echo "FT_USE_MODULE( FT_Driver_ClassRec, ${m}_class )" ;;
      *) echo "FT_USE_MODULE( FT_Module_Class, ${m}_class )" ;;
    esac
  done > "$o/freetype/config/ftmodule.h"
  for f in autofit/autofit base/ftbase base/ftinit base/ftsystem base/ftdebug base/ftbbox base/ftglyph base/ftbitmap base/ftmm cff/cff cid/type1cid gzip/ftgzip \
    psaux/psaux pshinter/pshinter psnames/psnames sfnt/sfnt truetype/truetype type1/type1; do
    echo "$s/src/$f.c"
  done | compile freetype emcc -DFT2_BUILD_LIBRARY -DFT_CONFIG_OPTION_SYSTEM_ZLIB -I"$o" -I"$s/include" -I"$dir/include" $jumps
}

build_geos() {
  s=$dir/sources/geos o=$dir/objects/geos-made
  mkdir -p "$o/geos"
  . "$s/Version.txt"
  capi="$GEOS_VERSION_MAJOR.$GEOS_VERSION_MINOR.$GEOS_VERSION_PATCH"
  sed -e "s/@GEOS_VERSION_MAJOR@\|@VERSION_MAJOR@/$GEOS_VERSION_MAJOR/; s/@GEOS_VERSION_MINOR@\|@VERSION_MINOR@/$GEOS_VERSION_MINOR/" \
    -e "s/@GEOS_VERSION_PATCH@\|@VERSION_PATCH@/$GEOS_VERSION_PATCH/; s/@[A-Z_]*VERSION@/$capi/; s/@CAPI_VERSION_MAJOR@/1/; s/@CAPI_VERSION_MINOR@/17/" \
    -e 's/@CAPI_VERSION_PATCH@/1/; s/@[A-Za-z_]*@/0/' "$s/capi/geos_c.h.in" > "$dir/include/geos_c.h"
  sed -e "s/@GEOS_VERSION_MAJOR@\|@VERSION_MAJOR@/$GEOS_VERSION_MAJOR/; s/@GEOS_VERSION_MINOR@\|@VERSION_MINOR@/$GEOS_VERSION_MINOR/" \
    -e "s/@GEOS_VERSION_PATCH@\|@VERSION_PATCH@/$GEOS_VERSION_PATCH/; s/@[A-Z_]*VERSION@/$capi/; s/@[A-Za-z_]*@/0/" \
    "$s/include/geos/version.h.in" > "$o/geos/version.h"
  find "$s/src/deps" -name '*.c' | compile ryu emcc -I"$s/src/deps"
  { find "$s/src" -name '*.cpp'; echo "$s/capi/geos_c.cpp"; echo "$s/capi/geos_ts_c.cpp"; } | sort |
    compile geos em++ -std=c++11 -DNDEBUG -fwasm-exceptions -I"$o" -I"$dir/include" -I"$s/include" -I"$s/src/deps"
}

jumps="-fwasm-exceptions -sSUPPORT_LONGJMP=wasm" # libpng and FreeType leave by longjmp
for row in "gmp gmp" "utf8proc utf8proc" "z zlib" "png libpng1.6" "jansson jansson" "expat expat" "freetype freetype" "geos geos"; do
  library=${row% *}
  ready "$library" && continue
  fetch "${row#* }"
  build_$library
done
