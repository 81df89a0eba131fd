#!/usr/bin/env bash
# Installs, builds and runs every test. Needs neither GPU nor display; goes on after a failure and says at the end what failed.
set -uo pipefail
cd "$(dirname "$0")/.."
. tools/packages.sh

usage() {
	cat <<'TEXT'
usage: tools/test.sh [--quick] [--all] [--long] [--only STAGE]...
  --quick       packages, format and every test of the release build: what every commit must pass
  --all         clang-tidy reads every file, however long it takes, not only those that changed
  --long        the long figures as well (tests labelled "long")
  --only STAGE  run this stage alone (may be given again): packages format release asan fuzz tsan tidy bench
TEXT
}

all_stages=(packages format release asan fuzz tsan tidy bench)
stages=()
tidy_all=false
long=false
while [ $# -gt 0 ]; do
	case "$1" in
	--quick)
		stages=(packages format release)
		;;
	--all) tidy_all=true ;;
	--long) long=true ;;
	--only)
		case " ${all_stages[*]} " in
		*" ${2:-} "*) stages+=("$2") ;;
		*)
			echo "tools/test.sh: --only expects one of: ${all_stages[*]}; found \"${2:-}\"" >&2
			exit 2
			;;
		esac
		shift
		;;
	--help)
		usage
		exit 0
		;;
	*)
		echo "tools/test.sh: unknown option \"$1\"; --help lists them" >&2
		exit 2
		;;
	esac
	shift
done
[ ${#stages[@]} -gt 0 ] || stages=("${all_stages[@]}")

jobs=$(nproc)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export NINJA_STATUS='[%f/%t] ' CTEST_OUTPUT_ON_FAILURE=1 CCACHE_NOHASHDIR=1
unset ARIFT_CONFIG ARIFT_SERVICE XR_RUNTIME_JSON XR_ENABLE_API_LAYERS DISPLAY WAYLAND_DISPLAY
label_filter=(-LE long)
if $long; then label_filter=(); fi
suppressions=$PWD/tests/suppressions
sanitizers=(
	ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1
	UBSAN_OPTIONS=print_stacktrace=1
	LSAN_OPTIONS="suppressions=$suppressions/lsan.supp:print_suppressions=0"
	TSAN_OPTIONS="suppressions=$suppressions/tsan.supp:halt_on_error=1:second_deadlock_stack=1"
)

# build PRESET [TARGET]...
build() {
	local preset=$1
	shift
	cmake --preset "$preset" >"$work/configure" 2>&1 || { cat "$work/configure"; return 1; }
	ninja -C "build/$preset" -j "$jobs" "$@"
}
# run_ctest PRESET NAME ARGUMENTS...: keeps CTest's closing lines for the summary, and what the tests that failed said
run_ctest() {
	local preset=$1 name=$2 result
	shift 2
	ctest --test-dir "build/$preset" -j "$jobs" --no-tests=error "$@" 2>&1 | tee "$work/ctest.$name"
	result=${PIPESTATUS[0]}
	grep -E '^[0-9]+% tests passed|^Total Test time' "$work/ctest.$name" | tail -2 >"$work/summary.$name"
	[ "$result" = 0 ] || grep -aE -A 8 ': Failure$|Sanitizer: |runtime error: |what\(\): |\*\*\*(Failed|Timeout|Exception)' "$work/ctest.$name" >"$work/failures.$name"
	return "$result"
}

# What shaders/ holds is GLSL that C++ reads too: clang-format does not know it.
sources() { git ls-files --cached --others --exclude-standard -- '*.h' '*.cpp' ':!shaders'; }

stage_packages() { install_packages test; }

stage_format() {
	sources | xargs clang-format-14 --dry-run -Werror && echo "format: $(sources | wc -l) files as .clang-format has them"
}

stage_release() {
	local result
	build release || return 1
	run_ctest release release "${label_filter[@]}"
	result=$?
	echo
	echo "figures that tests found:"
	grep -ha '^\[ FIGURE' build/release/Testing/Temporary/LastTest.log || echo "  none"
	return $result
}

stage_asan() {
	build asan && (export "${sanitizers[@]}" && run_ctest asan asan -LE 'long|layering|release')
}

# fuzz FUZZER: says what it found; fails if that is anything
fuzz() {
	local fuzzer=$1 name=${1##*/} found
	mkdir -p "$work/$name"
	if (cd "$work" &&
		"$OLDPWD/$fuzzer" -max_total_time=10 -timeout=5 -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$work/$name." \
			"$work/$name" "$OLDPWD/tests/fuzz/corpus/${name#fuzz_}") >"$work/$name.log" 2>&1; then
		sed -n "s/^.*number_of_executed_units: */fuzz: $name, ten seconds, inputs: /p" "$work/$name.log"
		return 0
	fi
	tail -40 "$work/$name.log"
	echo "fuzz: $name found an input that breaks it:"
	for found in "$work/$name".*-*; do [ -f "$found" ] && { echo "$found"; base64 "$found"; }; done
	return 1
}
# Each fuzzer runs its committed corpus as a test of the asan build already; here it also looks for new inputs, as many at a time as there
# are processors.
stage_fuzz() {
	build asan fuzzers || return 1
	(
		export "${sanitizers[@]}" work
		export -f fuzz
		printf '%s\0' build/asan/bin/fuzz_* | xargs -0 -P "$jobs" -n 1 bash -c 'fuzz "$0"'
	)
}

stage_tsan() {
	build tsan thread_tests && (export "${sanitizers[@]}" && run_ctest tsan tsan -L threads -LE 'long|gpu')
}

# Where the changes under test begin: where they left the last release or the main branch, else the commit before. Nothing where the
# clone is too shallow to know.
changes_begin() {
	local head from base
	head=$(git rev-parse HEAD)
	for from in "$(git describe --tags --abbrev=0 2>/dev/null)" origin/HEAD HEAD~1; do
		base=$(git merge-base HEAD "${from:-none}" 2>/dev/null) && [ "$base" != "$head" ] && echo "$base" && return
	done
	return 1
}
# includers HEADER: the files that include it, by its path from the root or, beside it, by its name.
includers() {
	git grep --untracked -lE "^[ 	]*#[ 	]*include[ 	]*[\"<]$1[\">]" -- '*.h' '*.cpp'
	git grep --untracked -lE "^[ 	]*#[ 	]*include[ 	]*\"${1##*/}\"" -- "${1%/*}/*.h" "${1%/*}/*.cpp"
}
# The .cpp files through which clang-tidy sees what changed since a commit: those changed first, then those that include a changed header,
# by way of other headers where no other file does.
changed_since() {
	local headers header found
	{
		git diff --name-only --diff-filter=d "$1" -- '*.h' '*.cpp'
		git ls-files --others --exclude-standard -- '*.h' '*.cpp'
	} | sort -u >"$work/changed"
	grep '\.cpp$' "$work/changed"
	headers=$(grep '\.h$' "$work/changed")
	while [ -n "$headers" ]; do
		for header in $headers; do
			found=$(includers "$header" | sort -u)
			grep '\.cpp$' <<<"$found" || grep '\.h$' <<<"$found" >>"$work/passed_on"
		done
		headers=$(sort -u "$work/passed_on" 2>/dev/null | grep -vxFf "$work/changed")
		cat "$work/passed_on" >>"$work/changed" 2>/dev/null
		rm -f "$work/passed_on"
	done
}

# As many at a time as there are processors, for at most three minutes: what is left then is named and belongs to a run with --all. What
# the newest commit changed comes first. Where it is not known what changed, every file is read as far as time allows, in another order
# each time.
stage_tidy() {
	local limit=180 base commit result
	# It reads what the compiler would: generated and precompiled headers too.
	build tidy arift_shaders arift_gtest_headers runtime/gpu/CMakeFiles/arift_gpu.dir/cmake_pch.hxx.pch >"$work/tidy.build" 2>&1 || { tail -20 "$work/tidy.build"; return 1; }
	if $tidy_all; then
		limit=86400
		sources | grep '\.cpp$' >"$work/tidy.files"
	elif base=$(changes_begin); then
		for commit in $(git rev-parse -q --verify HEAD~1) "$base"; do changed_since "$commit"; done | awk '!seen[$0]++' >"$work/tidy.files"
	else
		echo "tidy: this clone does not say what changed: every file, for at most $((limit / 60)) minutes"
		sources | grep '\.cpp$' | shuf >"$work/tidy.files"
	fi
	[ -s "$work/tidy.files" ] || { echo "tidy: no file changed"; return 0; }
	: >"$work/tidy.unread"
	deadline=$(($(date +%s) + limit)) unread=$work/tidy.unread xargs -P "$jobs" -n 1 bash -c '
		if [ "$(date +%s)" -gt "$deadline" ]; then echo "$0" >>"$unread"; else
			clang-tidy-14 --quiet -p build/tidy "$0" 2>/dev/null
		fi' <"$work/tidy.files"
	result=$?
	sed 's/^/tidy: not read for want of time: /' "$work/tidy.unread"
	echo "tidy: $(($(wc -l <"$work/tidy.files") - $(wc -l <"$work/tidy.unread"))) of $(wc -l <"$work/tidy.files") files read"
	return $result
}

stage_bench() {
	local bench
	for bench in build/release/bin/bench_*; do
		[ -x "$bench" ] || continue
		"$bench" --benchmark_min_time=0.1 --benchmark_color=false 2>"$work/bench.err" || { cat "$work/bench.err"; return 1; }
	done
}

failed=()
lines=()
start=$(date +%s)
for stage in "${stages[@]}"; do
	echo
	echo "==== $stage"
	began=$(date +%s)
	if "stage_$stage"; then verdict=passed; else
		verdict=FAILED
		failed+=("$stage")
	fi
	lines+=("$(printf '%-9s %s  %4d s' "$stage" "$verdict" $(($(date +%s) - began)))")
done

echo
echo "==== summary after $((($(date +%s) - start) / 60)) min"
for line in "${lines[@]}"; do
	echo "$line"
	name=${line%% *}
	[ -f "$work/summary.$name" ] && sed 's/^/          /' "$work/summary.$name"
done
for name in "${failed[@]}"; do
	[ -s "$work/failures.$name" ] || continue
	echo
	echo "---- what failed in $name"
	head -120 "$work/failures.$name"
done
if [ ${#failed[@]} -gt 0 ]; then
	echo "FAILED: ${failed[*]}"
	exit 1
fi
echo "all passed"
