#!/usr/bin/env bash
# See the world through the headset with a hologram in it: installs, builds, runs, takes pictures and prints the figures.
set -euo pipefail
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
  --app COMMAND ... any OpenXR application instead of the sample; takes the rest of the line
TEXT
}
stop() {
	echo "tools/demo.sh: $*" >&2
	exit 2
}

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
		[ -d "${2:-}" ] || [[ -f ${2:-} && $2 == *.brd ]] || stop "--recording expects a folder in the EuRoC layout or a .brd file, found \"${2:-}\""
		recording=$(realpath "$2")
		shift
		;;
	--motion)
		[ -f "${2:-}" ] || stop "--motion expects a file, found \"${2:-}\""
		motion=$(realpath "$2")
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
finish() {
	local pid
	for pid in $app_pid $service_pid; do kill "$pid" 2>/dev/null && wait "$pid" 2>/dev/null || true; done
	rm -rf "$work"
}
trap finish EXIT
trap 'exit 130' INT TERM
mkdir -m 700 "$work/run" "$work/config" "$work/state"
export XDG_RUNTIME_DIR=$work/run XDG_CONFIG_HOME=$work/config XDG_STATE_HOME=$work/state
export XR_RUNTIME_JSON=$PWD/$build/openxr_arift.json
unset ARIFT_CONFIG ARIFT_SERVICE XR_ENABLE_API_LAYERS

settings=(--set headset.driver=synthetic)
if [ -n "$recording" ]; then
	settings=(--set headset.driver=replay --set "replay.recording=$recording")
	[ -f "$recording" ] || settings+=(--set headset.rig=recording)
fi
[ -z "$motion" ] || settings+=(--set synthetic.motion=file --set "synthetic.motion_file=$motion")
[ -n "${DISPLAY:-}" ] && settings+=(--set compositor.target=window) || settings+=(--set compositor.target=offscreen)

echo "starting the service: arift-service ${settings[*]}"
"$bin/arift-service" "${settings[@]}" >"$work/service.log" 2>&1 &
service_pid=$!
for ((tries = 0; ; ++tries)); do
	"$bin/arift" status --json >"$work/status.json" 2>/dev/null && break
	if [ "$tries" -ge 300 ] || ! kill -0 "$service_pid" 2>/dev/null; then
		cat "$work/service.log" >&2
		stop "the service did not start"
	fi
	sleep 0.1
done

[ ${#app[@]} -gt 0 ] || app=("$bin/hologram_cube")
echo "running ${app[*]} for $seconds s"
"${app[@]}" >"$work/app.log" 2>&1 &
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
kill "$app_pid" 2>/dev/null && wait "$app_pid" 2>/dev/null || true
app_pid=

# Registration is measured on a service of its own, in stepped time: the same figure on every machine.
echo "measuring the registration error"
if "$registration" >"$work/registration.json" 2>"$work/registration.log"; then
	error=$(jq -r '"\(.median) / \(.p99)"' "$work/registration.json")
else
	error=-
	cat "$work/registration.log" >&2
fi

figure() { jq -r "$1" "$work/status.json"; }
row() { printf '  %-44s %s\n' "$1" "$2"; }
echo
echo "$(figure .headset.name), $(figure '[.clients[].name] | join(", ")')"
row "frames shown per second" "$(figure .frames.perSecond)"
row "missed frames" "$(figure .frames.missed)"
row "age of the camera image when shown, ms *" "$(figure '"\(.frames.cameraAgeMs.median) / \(.frames.cameraAgeMs.p99)"')"
row "age of the pose when shown, ms *" "$(figure '"\(.frames.poseAgeMs.median) / \(.frames.poseAgeMs.p99)"')"
row "registration error, panel pixels *" "$error"
echo "  * median / 99th percentile"
echo "pictures: demo/panel.png (what the display shows), demo/eyes.png (both eyes before the lens correction)"
