#!/usr/bin/env bash
# Builds the Linux archive of a release: the static program, completions, manual pages, documents, the files that they
# name (missions, designs, examples for the API), and licences.
#
#   contrib/release.sh [TARGET] [FOLDER]
#
# TARGET is x86_64-unknown-linux-musl or aarch64-unknown-linux-musl, that of this machine by default; FOLDER is
# target/dist. Needs `rustup target add TARGET` and musl's C compiler (`apt install musl-tools`). Equal commits, toolchains
# and C compilers make equal archives.
set -euo pipefail
cd "$(dirname "$0")/.."

target=${1:-$(uname -m)-unknown-linux-musl}
dist=${2:-target/dist}
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
name=sortie-$version-$target
stage=$dist/$name

# No path and no time of this machine in the program.
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
home=${CARGO_HOME:-$HOME/.cargo}
export SOURCE_DATE_EPOCH CARGO_INCREMENTAL=0
# Quoted, because a folder's name may have blanks.
CFLAGS=$(printf '%q %q' "-ffile-prefix-map=$PWD=/sortie" "-ffile-prefix-map=$home=/cargo")
export CFLAGS CC_SHELL_ESCAPED_FLAGS=1
separator=$'\x1f'
CARGO_ENCODED_RUSTFLAGS="--remap-path-prefix=$PWD=/sortie$separator--remap-path-prefix=$home=/cargo"
CARGO_ENCODED_RUSTFLAGS+="$separator-Ctarget-feature=+crt-static"
export CARGO_ENCODED_RUSTFLAGS
cargo build --release --locked --target "$target" --bin sortie
unset CARGO_ENCODED_RUSTFLAGS CFLAGS CC_SHELL_ESCAPED_FLAGS
program=${CARGO_TARGET_DIR:-target}/$target/release/sortie

rm -rf "$stage"
mkdir -p "$stage/completions" "$stage/systemd" "$stage/licences"
cp "$program" "$stage/"
# From the working tree, as the program, but only what is tracked.
git ls-files -z README.md CHANGELOG.md LICENSE ':(glob)docs/*.md' ':(glob)docs/images/*.svg' missions designs examples/api |
    tar --create --null --files-from=- | tar --extract --directory "$stage"
cp contrib/sortie-hangar.service "$stage/systemd/"
for shell in bash zsh fish elvish powershell; do
    "$program" completions "$shell" >"$stage/completions/sortie.$shell"
done
"$program" man --dir "$stage/man/man1"
cargo run --quiet --locked --example third_party -- "$target" >"$stage/THIRD-PARTY.md"
# What the archive was built from.
{
    git log -1 --format='commit %H'
    rustc --version
    cargo --version
} >"$stage/BUILD"
# What is in the program besides crates.
cp "$(rustc --print sysroot)/share/doc/rust/COPYRIGHT-library.html" "$stage/licences/rust-std.html"
case $target in
*-musl) cp contrib/licences/musl.txt "$stage/licences/" ;;
*-gnu) cp /usr/share/doc/libc6/copyright "$stage/licences/glibc.txt" ;;
esac

# What a static program must not need.
case $(ldd "$program" 2>&1 || true) in
*'=>'*)
    echo "$program is not static" >&2
    exit 1
    ;;
esac
tar --create --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner \
    --mode=go=rX,u+rw --directory "$dist" "$name" | gzip --no-name --best >"$dist/$name.tar.gz"
(cd "$dist" && sha256sum "$name.tar.gz" >"$name.tar.gz.sha256")
cat "$dist/$name.tar.gz.sha256"
