#!/usr/bin/env bash
# See the world through the headset with a hologram in it: installs, builds, runs, takes pictures and prints the figures.
set -euo pipefail
here=$PWD # what the command line names lies there
cd "$(dirname "$0")/.."
. tools/packages.sh

usage() {
	cat <<'TEXT'
usage: tools/demo.sh [--seconds N] [--recording PATH] [--motion FILE] [--app COMMAND [ARGUMENT]...]
Builds ARift, starts its service with the synthetic headset (nothing of yours is touched: socket, settings and log are private to this run), runs
samples/hologram_cube, and writes demo/panel.png (what the display shows) and demo/eyes.png (both eyes before the lens correction) and a table.
With a display (DISPLAY is set) the panel is shown in a window as well.
  --seconds N       how long to run before the pictures are taken (default 10)
  --recording PATH  instead of the synthetic sensors: a folder in the EuRoC layout (cameras and tracker), or a .brd file (tracker alone)
  --motion FILE     how the synthetic head moves: a recorded trajectory (.csv or .brd)
  --app COMMAND ... any OpenXR application instead of the sample, run where you stand; takes the rest of the line
TEXT
}
stop() {
	echo "tools/demo.sh: $*" >&2
	exit 2
}

absolute() { case "$1" in /*) echo "$1" ;; *) echo "$here/$1" ;; esac; }

seconds=10
recording=
motion=
app=()
while [ $# -gt 0 ]; do
	case "$1" in
	--seconds)
		[[ ${2:-} =~ ^[1-9][0-9]{0,4}$ ]] || stop "--seconds expects a whole number from 1 to 99999, found \"${2:-}\""
		seconds=$2
		shift
		;;
	--recording)
		recording=$(absolute "${2:-}")
		[ -n "${2:-}" ] && { [ -d "$recording" ] || [[ -f $recording && $recording == *.brd ]]; } ||
			stop "--recording expects a folder in the EuRoC layout or a .brd file, found \"${2:-}\""
		shift
		;;
	--motion)
		motion=$(absolute "${2:-}")
		[ -f "$motion" ] || stop "--motion expects a file, found \"${2:-}\""
		shift
		;;
	--app)
		shift
		[ $# -gt 0 ] || stop "--app expects a command"
		app=("$@")
		break
		;;
	--help)
		usage
		exit 0
		;;
	*) stop "unknown option \"$1\"; --help lists them" ;;
	esac
	shift
done
[ -z "$recording" ] || [ -z "$motion" ] || stop "--recording brings its own motion: --motion cannot be given as well"

build=build/release
registration=$build/bin/registration_probe
install_packages demo
echo "building (the first time takes some minutes)"
cmake --preset release >/dev/null
NINJA_STATUS='[%f/%t] ' ninja -C "$build" arift-service arift openxr_arift hologram_cube registration_probe
bin=$PWD/$build/bin

# Everything of this run lies in one folder and goes with it; the processes are ended by their numbers.
work=$(mktemp -d)
service_pid=
app_pid=
# end PID: asks it to, and after five seconds makes it.
end() {
	kill "$1" 2>/dev/null || return 0
	for ((waited = 0; waited < 50; ++waited)); do
		kill -0 "$1" 2>/dev/null || break
		sleep 0.1
	done
	kill -KILL "$1" 2>/dev/null || true
	wait "$1" 2>/dev/null || true
}
finish() {
	local result=$? pid
	for pid in $app_pid $service_pid; do end "$pid"; done
	[ "$result" -eq 0 ] || [ ! -s "$work/service.log" ] || { echo "the service's last words:" >&2 && tail -20 "$work/service.log" >&2; }
	rm -rf "$work"
}
trap finish EXIT
trap 'exit 130' INT TERM
mkdir -m 700 "$work/run" "$work/config" "$work/state"
# The application keeps its settings and, through links, the sockets of the desktop it runs on; only the service's folders are others.
if [ -d "${XDG_RUNTIME_DIR:-}" ]; then
	for socket in "$XDG_RUNTIME_DIR"/{wayland-*,pipewire-*,pulse,bus}; do [ ! -e "$socket" ] || ln -s "$socket" "$work/run/"; done
fi
export XDG_RUNTIME_DIR=$work/run
export XR_RUNTIME_JSON=$PWD/$build/openxr_arift.json
unset ARIFT_CONFIG ARIFT_SERVICE XR_ENABLE_API_LAYERS
private=(env "XDG_CONFIG_HOME=$work/config" "XDG_STATE_HOME=$work/state")

settings=(--set headset.driver=synthetic)
if [ -n "$recording" ]; then
	settings=(--set headset.driver=replay --set "replay.recording=$recording")
	[ -f "$recording" ] || settings+=(--set headset.rig=recording)
fi
[ -z "$motion" ] || settings+=(--set synthetic.motion=file --set "synthetic.motion_file=$motion")
[ -n "${DISPLAY:-}" ] && settings+=(--set compositor.target=window) || settings+=(--set compositor.target=offscreen)

echo "starting the service: arift-service ${settings[*]}"
began=$(date +%s%N)
"${private[@]}" "$bin/arift-service" "${settings[@]}" >"$work/service.log" 2>&1 &
service_pid=$!
for ((tries = 0; ; ++tries)); do
	"$bin/arift" status --json >"$work/status.json" 2>/dev/null && break
	if [ "$tries" -ge 600 ] || ! kill -0 "$service_pid" 2>/dev/null; then stop "the service did not start"; fi
	sleep 0.05
done
started=$((($(date +%s%N) - began) / 1000000))

[ ${#app[@]} -gt 0 ] || app=("$bin/hologram_cube")
echo "running ${app[*]} for $seconds s"
# Its keyboard is one that nobody types on: hello_xr ends with the first key, and with the end of its input.
mkfifo "$work/keyboard"
exec 3<>"$work/keyboard"
(cd "$here" && exec "${app[@]}") <&3 >"$work/app.log" 2>&1 &
app_pid=$!
app_ended() {
	cat "$work/app.log" >&2
	stop "the application ended by itself before the pictures were taken"
}
# The first second goes into pipelines and the first frames; the figures begin behind it.
sleep 1
"$bin/arift" status --json --reset >/dev/null
for ((second = 1; second <= seconds; ++second)); do
	sleep 1
	kill -0 "$app_pid" 2>/dev/null || app_ended
	"$bin/arift" status --json >"$work/status.json"
	printf '  %d of %d s, %s frames shown\n' "$second" "$seconds" "$(jq .frames.shown "$work/status.json")"
done
mkdir -p demo
"$bin/arift" screenshot demo/panel.png
"$bin/arift" screenshot --eyes demo/eyes.png
end "$app_pid"
app_pid=
end "$service_pid" # what is measured next has the machine for itself
service_pid=

# Registration is measured on a service of its own, in stepped time: the same figure on every machine.
echo "measuring the registration error"
"${private[@]}" "$registration" >"$work/registration.json" 2>"$work/registration.log" || {
	cat "$work/registration.log" >&2
	stop "the registration error could not be measured"
}
error=$(jq -r '[.median, .p99] | map(. * 100 | round / 100 | tostring) | join(" / ")' "$work/registration.json")

figure() { jq -r "$1" "$work/status.json"; }
row() { printf '  %-44s %s\n' "$1" "$2"; }
echo
echo "$(figure .headset.name), $(figure '[.clients[].name] | join(", ")')"
row "start-up of the service, ms" "$started"
row "frames shown per second" "$(figure '.frames.perSecond | . * 10 | round / 10')"
row "CPU per shown frame, ms" "$(figure '.frames.cpuMsPerFrame | . * 10 | round / 10')"
row "missed frames" "$(figure .frames.missed)"
row "age of the camera image when shown, ms *" "$(figure '"\(.frames.cameraAgeMs.median) / \(.frames.cameraAgeMs.p99)"')"
row "age of the pose when shown, ms *" "$(figure '"\(.frames.poseAgeMs.median) / \(.frames.poseAgeMs.p99)"')"
row "registration error, panel pixels * **" "$error"
echo "  * median / 99th percentile"
echo "  ** hologram against marker: synthetic sensors without noise, 2 m away, head turning at 100 degrees a second, in stepped time"
echo "pictures: demo/panel.png (what the display shows), demo/eyes.png (both eyes before the lens correction)"
