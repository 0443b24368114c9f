# Owns the test of web pages: every example as a page in Chromium, by playwright-core (tests/page/page.mjs). Small parameters where a model is large.
case page in *"${ONLY%%/*}"*) ;; *) exit 0 ;; esac
command -v chromium > /dev/null || { echo "skip page: no chromium (package chromium)"; exit 0; }
[ -d node_modules/playwright-core ] && [ -d node_modules/three ] || { echo "skip page: no playwright-core or no viewer (npm ci --ignore-scripts)"; exit 0; }
. tests/report.sh
for model in examples/*.vs; do
  name=$(basename "$model" .vs)
  case $name in city) set -- -D blocks=2 -D tallest=6 ;; *) set -- ;; esac
  "$BUILD/vs" --quiet "$@" "$model" -o "$work/$name.html" || echo "not ok page/$name: ended with $?"
done
for name in facade-stages plans cornice-corners four-trees lily massive-street; do
  case $name in massive-street) set -- -D lots=4 ;; *) set -- ;; esac
  "$BUILD/vs" --quiet "$@" "examples/rules/$name.vs" -o "$work/rules-$name.html" || echo "not ok page/rules-$name: ended with $?"
done
"$BUILD/vs" --quiet examples/doric-columns.vs -o "$work/doric-columns.x3d"
cat > "$work/hostile.vs" <<'EOF'
(draw (layer "<img src=x onerror=window.owned=1></script><script>owned=1</script>"
  (with-material (make-material #:name "<b onclick=owned=1>\"'&</style>" #:color "red") (make-box (xyz 0 0 0) (xyz 1 2 3)))))
EOF
mkdir "$work/<img src=x onerror=owned=1>" && cp "$work/hostile.vs" "$work/<img src=x onerror=owned=1>/<b>&amp;.vs"
"$BUILD/vs" --quiet "$work/<img src=x onerror=owned=1>/<b>&amp;.vs" -o "$work/hostile.html" || echo "not ok page/hostile: ended with $?"
timeout 600 node tests/page/page.mjs "$work" || echo "not ok page: ended with $?"
