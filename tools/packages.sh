# Sourced by demo.sh and test.sh: installs from Debian what tools/packages.txt lists and this machine lacks.

# install_packages demo|test
install_packages() {
	local list missing=() package kind status sudo=()
	list="$(dirname "${BASH_SOURCE[0]}")/packages.txt"
	while read -r package kind; do
		case "$package" in '' | '#'*) continue ;; esac
		[ "$kind" = test ] && [ "$1" != test ] && continue
		status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
		[ "$status" = "install ok installed" ] || missing+=("$package")
	done <"$list"
	if [ ${#missing[@]} -eq 0 ]; then
		echo "packages: all there"
		return
	fi
	echo "packages: installing ${missing[*]}"
	if ! command -v apt-get >/dev/null; then
		echo "packages: this system has no apt-get; install the packages above, named in tools/packages.txt, by its own means" >&2
		return 1
	fi
	if [ "$(id -u)" -ne 0 ]; then
		if ! command -v sudo >/dev/null; then
			echo "packages: run as root: apt-get install ${missing[*]}" >&2
			return 1
		fi
		sudo=(sudo)
		[ -t 0 ] || sudo=(sudo -n)
	fi
	"${sudo[@]}" apt-get update -q
	if ! "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"; then
		echo "packages: apt-get could not install ${missing[*]}" >&2
		return 1
	fi
}
