# Tests the live view: its server by HTTP (tests/page/live.mjs, live_requests.mjs), in a browser (live_browser.mjs,
# live_words.mjs, live_making.mjs, live_frames.mjs, live_joint.mjs, live_scene.mjs, live_examples.mjs, live_output.mjs, live_runs.mjs,
# live_typing.mjs, live_untrusted.mjs), and `vs params`.
case live in *"${ONLY%%/*}"*) ;; *) exit 0 ;; esac
command -v node > /dev/null || { echo "skip live: no node (package nodejs)"; exit 0; }
[ -d node_modules/three ] || { echo "skip live: built without the viewer (npm ci --ignore-scripts)"; exit 0; }
. tests/report.sh
why=$(no_terminal)
if [ -z "$why" ]; then
  mkdir "$work/prompt"
  timeout 200 node tests/page/follow.mjs "$BUILD/vs" "$work/prompt" || echo "not ok live/view at the prompt: ended with $?"
else echo "skip live/view at the prompt: $why"; fi
timeout 200 node tests/page/live.mjs "$BUILD/vs" "$work" || echo "not ok live: ended with $?"
timeout 200 node tests/page/live_requests.mjs "$BUILD/vs" "$work/requests" || echo "not ok live: requests ended with $?"
if command -v chromium > /dev/null && [ -d tests/node_modules/playwright-core ]; then
  mkdir "$work/tutorial"
  timeout 400 node tests/page/tutorial.mjs "$BUILD/vs" "$work/tutorial" || echo "not ok live/browser:tutorial: ended with $?"
  timeout 400 node tests/page/live_browser.mjs "$BUILD/vs" "$work/browser" || echo "not ok live/browser: ended with $?"
  timeout 400 node tests/page/live_words.mjs "$BUILD/vs" "$work/words" || echo "not ok live/browser: words ended with $?"
  timeout 200 node tests/page/live_making.mjs "$BUILD/vs" "$work/making" || echo "not ok live/browser: making ended with $?"
  timeout 200 node tests/page/live_scene.mjs "$BUILD/vs" "$work/scene" || echo "not ok live/browser: scene ended with $?"
  timeout 200 node tests/page/live_joint.mjs "$BUILD/vs" "$work/joint" || echo "not ok live/browser: joint ended with $?"
  timeout 200 node tests/page/live_frames.mjs "$BUILD/vs" "$work/frames" || echo "not ok live/browser: frames ended with $?"
  timeout 400 node tests/page/live_examples.mjs "$BUILD/vs" "$work/examples" || echo "not ok live/browser: examples ended with $?"
  timeout 400 node tests/page/live_runs.mjs "$BUILD/vs" "$work/runs" || echo "not ok live/browser: runs ended with $?"
  timeout 200 node tests/page/live_typing.mjs "$BUILD/vs" "$work/typing" || echo "not ok live/browser: typing ended with $?"
  timeout 200 node tests/page/live_untrusted.mjs "$BUILD/vs" "$work/stranger" || echo "not ok live/browser: untrusted ended with $?"
  timeout 400 node tests/page/live_output.mjs "$BUILD/vs" "$work/output" || echo "not ok live/browser: output ended with $?"
else
  echo "skip live/browser: no chromium (package chromium) or no playwright-core (npm ci --prefix tests --ignore-scripts)"
fi
