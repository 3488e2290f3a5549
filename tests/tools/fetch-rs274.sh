#!/bin/sh
# Unpacks LinuxCNC's rs274, the interpreter that tests compare ours with, into a directory, from Debian's packages.
#
#   tests/tools/fetch-rs274.sh DIR && PATHBUILD_RS274=DIR cargo test -p pathbuild-gcode --test rs274
#
# Nothing is installed. DIR/rs274 FILE then prints the canonical moves of a program; the exit status is 1 if it is wrong.
set -eu

[ $# -eq 1 ] || { echo "usage: $0 DIR" >&2; exit 2; }
for tool in apt-get apt-cache dpkg ldd; do
    command -v "$tool" >/dev/null || { echo "$0: $tool is missing: rs274 comes from Debian's package linuxcnc-uspace" >&2; exit 1; }
done

mkdir -p "$1"
dir=$(cd "$1" && pwd)
cd "$dir"
root=$dir/root

unpack() {
    apt-get -q download "$1" >/dev/null 2>apt.log || { cat apt.log >&2; echo "$0: cannot download $1" >&2; exit 1; }
    for package in "$1"_*.deb; do
        dpkg -x "$package" "$root"
        rm -f "$package"
    done
}

libraries() {
    find "$root/usr/lib" -maxdepth 2 -name 'lib*.so*' -exec dirname {} + | sort -u | tr '\n' ':'
}

# The package lists may be missing or older than the mirror.
apt-cache show linuxcnc-uspace >/dev/null 2>&1 || apt-get -q update >/dev/null 2>&1 || true
unpack linuxcnc-uspace

# Of its many dependencies, the libraries that the interpreter itself is linked with and that are not there. Package and library are
# matched by the first part of their names: libboost-python1.74.0 has libboost_python311.so.
for library in $(apt-cache depends linuxcnc-uspace | sed -n 's/^ *Depends: \(lib[a-z0-9.+-]*\)$/\1/p'); do
    missing=$(LD_LIBRARY_PATH=$(libraries) ldd "$root/usr/bin/rs274" | sed -n 's/^[[:space:]]*\(lib[^ ]*\) => not found$/\1/p')
    [ -n "$missing" ] || break
    stem=$(printf '%s' "$library" | sed 's/[0-9.]*$//')
    case "$missing" in *"$(printf '%s' "$stem" | cut -c4- | cut -d- -f1)"*) unpack "$library" ;; esac
done

printf 'T1 P1 D2.0 ;2mm\nT2 P2 D3.0 ;3mm\n' > "$dir/tool.tbl"
# Without a tool table it exits silently; concurrent runs with the same home directory disturb each other.
cat > "$dir/rs274" <<WRAPPER
#!/bin/sh
HOME=\$(mktemp -d)
export HOME
trap 'rm -rf "\$HOME"' EXIT
: > "\$HOME/parameters"
LD_LIBRARY_PATH='$(libraries)' '$root/usr/bin/rs274' -g -t '$dir/tool.tbl' -v "\$HOME/parameters" "\$@"
WRAPPER
chmod +x "$dir/rs274"

printf 'G0 X1\nM2\n' > "$dir/try.ngc"
"$dir/rs274" "$dir/try.ngc" | grep -q 'STRAIGHT_TRAVERSE(1.0000' || { echo "$0: $dir/rs274 does not run" >&2; exit 1; }
echo "rs274 is in $dir"
