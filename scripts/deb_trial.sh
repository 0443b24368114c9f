#!/bin/sh
# Tries the packages in a bare machine made by debootstrap, as root: in Debian bookworm the packages of BUILD/deb, in
# another release those that the script makes there from the release's sources. It installs them, runs the README's main
# job, removes them, and fails if the job's mesh differs from that of BUILD/vs or if a file is left.
#
#   scripts/deb_trial.sh BUILD VERSION bookworm|noble
#
# Ends with 3 if the machine's packages cannot be fetched.
#
#   VS=PROGRAM     the program whose mesh is compared: BUILD/vs
#   CACHE=FOLDER   the folder for the bare machine as a tar file: ~/.cache/visualscheme
set -u
cd "$(dirname "$0")/.." || exit 1
build=$1 version=$2 suite=$3 cache=${CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/visualscheme}
fail() { echo "$suite: $*" >&2; exit 1; }
[ "$(id -u)" = 0 ] || fail "chroot and mount need root"
command -v debootstrap > /dev/null || fail "no debootstrap"
build=$(cd "$build" && pwd) && log=$build/trial-$suite.log || exit 1
vs=${VS:-$build/vs}
mkdir -p "$cache"
root=$(mktemp -d -p "${TMPDIR:-/var/tmp}" vs-trial-XXXXXX) || exit 1
trap 'rm -rf "$root"' EXIT
trap 'exit 130' INT TERM

# Debian's mirror is that of this machine's apt.
sources=$(apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' | awk '$3 ~ /^bookworm/ && $4 == "main" && !seen[$0]++')
case $suite in
bookworm) mirror=$(echo "$sources" | awk '$3 == "bookworm" { print $2; exit }') script= components=main ;;
*) script=/usr/share/debootstrap/scripts/gutsy components=main,universe # the script of all releases of Ubuntu, with its mirror
   mirror=$(sed -n 's|^.*default_mirror *\(http://archive.*\)$|\1|p' $script | head -n 1) ;;
esac
tar=$cache/$suite-$(dpkg --print-architecture).tar
if [ ! -f "$tar" ]; then
  debootstrap --variant=minbase --include=make,ca-certificates --components=$components "$suite" "$root" $mirror $script > "$log" 2>&1 || { tail -n 3 "$log" >&2; echo "$suite: debootstrap could not make the machine" >&2; exit 3; }
  chroot "$root" apt-get clean
  tar -C "$root" -cf "$tar.part" . && mv "$tar.part" "$tar"
else tar -C "$root" -xf "$tar" || exit 1; fi
chmod 755 "$root"
[ "$suite" != bookworm ] || [ -z "$sources" ] || echo "$sources" > "$root/etc/apt/sources.list"
cp /etc/resolv.conf "$root/etc/resolv.conf"
apt-config dump | grep -i '^Acquire::https\?::Proxy' > "$root/etc/apt/apt.conf.d/proxy"

# inside COMMAND...: runs it in the machine, with /proc and processes of its own, which end with it.
inside() {
  unshare --mount --pid --fork --kill-child sh -c 'mount -t proc proc "$1/proc" && root=$1 && shift && exec chroot "$root" env -i HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"' \
    sh "$root" "$@" < /dev/null >> "$log" 2>&1
}
everything() { (cd "$root" && find . \( -path ./proc -o -path ./tmp -o -path ./var/cache -o -path ./var/log -o -path ./var/lib/dpkg -o -path ./etc/ld.so.cache -o -path ./root \) -prune -o -print | sort); }
install="apt-get -q -y --no-install-recommends -o APT::Keep-Downloaded-Packages=false"
: > "$log"
inside $install update || { echo "$suite: apt-get update failed" >&2; exit 3; }
mkdir "$root/root/deb"
if [ "$suite" = bookworm ]; then cp "$build"/deb/*.deb "$root/root/deb/" || fail "no packages: make deb"
else
  needs=$(awk '($1 == "build" || $1 == "deb") { print $2 }' scripts/packages.list)
  inside $install install gzip $needs || fail "the packages of the build cannot be installed"
  cp "$build/visualscheme-$version.tar.gz" "$root/root/" && tar -xzf "$root/root/visualscheme-$version.tar.gz" -C "$root/root" || exit 1
  mkdir -p "$root/root/visualscheme-$version/build" && cp "$build/visualscheme-$version.tar.gz" "$root/root/visualscheme-$version/build/"
  inside sh -c "cd /root/visualscheme-$version && sh scripts/deb.sh build $version && cp build/deb/*.deb /root/deb/" || fail "the packages cannot be made: $log"
fi

# First all that the packages depend on; then these alone come and go.
for file in "$root"/root/deb/*.deb; do dpkg-deb -f "$file" Depends; done | tr ',' '\n' | sed 's/^ *//' | grep -v '^libvisualscheme' | sort -u > "$root/root/needs"
inside $install satisfy "$(paste -s -d , "$root/root/needs")" povray || fail "what the packages depend on cannot be installed"
everything > "$root/root/before"
inside dpkg -i $(cd "$root" && ls root/deb/*.deb | sed 's|^|/|') || fail "dpkg -i failed: $log"
awk '/^```scheme$/ { on = 1; next } /^```$/ { if (on) exit } on' README.md > "$root/root/columns.vs"
job="vs -q columns.vs -o columns.png -o columns.html -o columns.stl"
inside sh -c "cd /root && $job && man -w vs; vs --version | head -n 1" || fail "$job failed: $log"
for file in png html stl; do [ -s "$root/root/columns.$file" ] || fail "no columns.$file"; done
"$vs" -q "$root/root/columns.vs" -o "$root/root/here.stl" && cmp "$root/root/here.stl" "$root/root/columns.stl" || fail "the mesh is another than that of $vs"
inside dpkg --purge visualscheme libvisualscheme-dev libvisualscheme0 || fail "dpkg --purge failed"
everything | diff "$root/root/before" - > "$root/root/left" || { head -n 10 "$root/root/left" >&2; fail "files are left"; }
echo "$suite: installed, ran, removed; $(cd "$root/root/deb" && ls | wc -l) packages of $(du -sk "$root/root/deb" | cut -f 1) KB"
