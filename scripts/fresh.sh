#!/bin/sh
# Runs the trial on a fresh machine: a bare Debian bookworm in a separate folder (debootstrap, make, ca-certificates and
# a clone of the committed files). There it runs the README's two commands as a new user would, and then the first one
# without access to npm. Prints sizes and times at the end; fails if a file of the demonstration is missing or a test
# failed. Needs root: chroot and mount.
#
#   DEVICES=no     as in a container with neither pseudo-terminals nor shared memory
#   STEPS="demo"   only these of demo, test, offline
#   MIRROR=URL     fetch Debian's packages there; unset: from the source of this machine's apt, or debootstrap's default
#   KEEP=1         keep the machine's folder
#   ROOT=FOLDER    go on in a machine that KEEP=1 has kept, with the files that are committed now
#   CACHE=FOLDER   the folder for the bare machine as a tar file, for the next run: ~/.cache/visualscheme
set -u
cd "$(dirname "$0")/.." || exit 1
[ "$(id -u)" = 0 ] || exec sudo --preserve-env env "PATH=$PATH" sh scripts/fresh.sh
cache=${CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/visualscheme} steps=${STEPS:-demo test offline}
tar=$cache/bookworm-$(dpkg --print-architecture).tar
logs=$PWD/${BUILD:-build}/fresh
mkdir -p "$cache" "$logs" && rm -f "$logs"/*.log
root=${ROOT:-$(mktemp -d -p "${TMPDIR:-/var/tmp}" vs-fresh-XXXXXX)} || exit 1
end() { if [ -n "${KEEP:-}${ROOT:-}" ]; then echo "the machine is in $root"; else rm -rf "$root"; fi; }
trap end EXIT
trap 'exit 130' INT TERM

# ---- the bare machine ----

# Debian's lines of this machine's apt, if it is a bookworm, too.
sources=$(apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' | awk '$3 ~ /^bookworm/ && $4 == "main" && !seen[$0]++')
mirror=${MIRROR:-$(echo "$sources" | awk '$3 == "bookworm" { print $2; exit }')}
if [ -n "${ROOT:-}" ]; then echo "Going on in $root"
elif [ ! -f "$tar" ] || [ -n "$(find "$tar" -mtime +30)" ]; then
  echo "Making a bare machine with debootstrap: $tar"
  debootstrap --variant=minbase --include=make,ca-certificates bookworm "$root" $mirror > "$logs/debootstrap.log" 2>&1 || { tail -n 5 "$logs/debootstrap.log"; exit 1; }
  chroot "$root" apt-get clean
  tar -C "$root" -cf "$tar.part" . && mv "$tar.part" "$tar"
else
  tar -C "$root" -xf "$tar" || exit 1
fi
chmod 755 "$root" # mktemp's is closed to apt's own user
[ -n "${MIRROR:-}" ] || [ -z "$sources" ] || echo "$sources" > "$root/etc/apt/sources.list"

# The network access is that of this machine: names, proxies, certificates, and npm's source.
cp /etc/resolv.conf "$root/etc/resolv.conf"
apt-config dump | grep -i '^Acquire::https\?::Proxy' > "$root/etc/apt/apt.conf.d/proxy"
set --
for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
  eval "value=\${$name:-}"
  [ -z "$value" ] || set -- "$@" "$name=$value"
done
if [ -f "${NODE_EXTRA_CA_CERTS:-}" ]; then cp "$NODE_EXTRA_CA_CERTS" "$root/etc/ssl/network.crt"; set -- "$@" NODE_EXTRA_CA_CERTS=/etc/ssl/network.crt; fi
if command -v npm > /dev/null; then set -- "$@" "npm_config_registry=$(npm config get registry)"; fi
if [ -d "$root/root/visualscheme" ]; then git -C "$root/root/visualscheme" fetch -q "$PWD" HEAD && git -C "$root/root/visualscheme" checkout -q --detach FETCH_HEAD
else git clone -q --no-local . "$root/root/visualscheme"; fi || exit 1

# ---- the steps ----

size() { du -smx "$root" | awk '{ print $1 }'; }
row() { printf '%-9s %7s s %6s MB   %s\n' "$1" "$2" "$3" "$4" >> "$logs/table"; }
fault() { echo "$*" >> "$logs/faults"; }
: > "$logs/table"; : > "$logs/faults"
row "$([ -n "${ROOT:-}" ] && echo before || echo bare)" 0 "$(size)" "$([ -n "${ROOT:-}" ] || echo "debootstrap, make, ca-certificates, a clone")"

# inside STEP COMMAND [NAME=VALUE...]: runs the command in the machine, with separate processes and /proc, which end
# with the command. Sets seconds, status and log.
cat > "$root/root/run" <<'END'
cd /root/visualscheme && exec sh -c "$1"
END
inside() {
  log=$logs/$1.log command=$2; shift 2
  echo "== $command"
  begin=$(date +%s)
  { unshare --mount --pid --fork --kill-child sh -c '
      root=$1 devices=$2; shift 2
      mount -t proc proc "$root/proc" || exit 1
      if [ "$devices" != no ]; then
        mkdir -p "$root/dev/pts" "$root/dev/shm"
        mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts" && mount --bind "$root/dev/pts/ptmx" "$root/dev/ptmx" && mount -t tmpfs tmpfs "$root/dev/shm" || exit 1
      fi
      exec chroot "$root" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$@"' \
      sh "$root" "${DEVICES:-yes}" "$@" sh /root/run "$command" < /dev/null 2>&1; echo "$?" > "$logs/status"; } | tee "$log"
  status=$(cat "$logs/status") seconds=$(($(date +%s) - begin))
}
made() { # EXTENSION...: which of the demonstration's files are there; the others are faults
  for e in "$@"; do if [ -s "$root/root/visualscheme/out/gare-do-oriente.$e" ]; then printf '%s ' "$e"; else fault "demo: no .$e"; fi; done
}

for step in $steps; do
  case $step in
  demo)
    inside demo "make demo" "$@"
    [ "$status" = 0 ] || fault "make demo: ended with $status"
    row "make demo" "$seconds" "$(size)" "$(made png html scad stl)" ;;
  test)
    inside test "make test" "$@"
    [ "$status" = 0 ] || fault "make test: ended with $status"
    row "make test" "$seconds" "$(size)" "$(grep -a 'passed, .* failed' "$log" | tail -n 1)" ;;
  offline)
    (cd "$root/root/visualscheme" && rm -rf out node_modules build/viewer.js build/live.js)
    inside offline "make demo" "$@" npm_config_registry=http://127.0.0.1:9/
    [ "$status" = 0 ] || fault "make demo without npm: ended with $status"
    [ "$(grep -a -c '^warning: ' "$log")" = 1 ] && tail -n 1 "$log" | grep -q '^warning: no web page: .' || fault "make demo without npm: its last line is not the one warning"
    [ ! -e "$root/root/visualscheme/out/gare-do-oriente.html" ] || fault "make demo without npm: there is a page"
    row "no npm" "$seconds" "$(size)" "$(made png scad stl)" ;;
  esac
done

echo
sort "$logs/faults"
grep -a -h '^skip ' "$logs/test.log" 2> /dev/null | sort -u
echo
cat "$logs/table"
chroot "$root" sh -c 'echo "node $(node --version 2> /dev/null), $(dpkg-query -f "." -W | wc -c) packages of Debian"; cd /root/visualscheme; du -sm build out node_modules tests/node_modules /usr /var/cache/apt /var/lib/apt 2> /dev/null | sort -rn'
[ ! -s "$logs/faults" ]
