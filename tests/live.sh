# Owns the test of the live view: its server by HTTP (tests/page/live.mjs), and `vs params`.
case live in *"${ONLY%%/*}"*) ;; *) exit 0 ;; esac
command -v node > /dev/null || { echo "skip live: no node (package nodejs)"; exit 0; }
[ -d node_modules/three ] || { echo "skip live: built without the viewer (npm ci --ignore-scripts)"; exit 0; }
. tests/report.sh
timeout 200 node tests/page/live.mjs "$BUILD/vs" "$work" || echo "not ok live: ended with $?"
