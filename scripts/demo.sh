#!/bin/sh
# Makes the demonstration: one model, the Gare do Oriente, as a picture, a web page, an OpenSCAD program and a mesh to
# print. If npm could not fetch the viewer there is no page, and the last line gives the reason, which
# scripts/install.sh wrote to a file. The exit code is that of vs.
set -u
vs=$1
build=$(dirname "$vs") name=gare-do-oriente status=0
mkdir -p out
page="-o out/$name.html"
[ -s "$build/viewer.js" ] || { page=; rm -f "out/$name.html"; }
echo "Making out/$name.png with POV-Ray, a minute or some, and $([ -z "$page" ] || echo "a page, ")a program and a mesh"
"$vs" examples/$name.vs --units mm -o out/$name.png $page -o out/$name.scad -o out/$name.stl || status=$?
tell() { [ ! -f "out/$name.$1" ] || printf '  out/%-22s %s\n' "$name.$1" "$2"; }
echo
echo "Made from examples/$name.vs:"
tell png "the picture"
tell html "open it in a browser and turn the model"
tell scad "open it in OpenSCAD"
tell stl "a closed mesh, ready to print"
[ -n "$page" ] || echo "warning: no web page: $(cat "$build/no-page" 2> /dev/null || echo "built without what npm fetches"); make demo tries again" >&2
exit $status
