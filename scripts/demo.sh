#!/bin/sh
# Owns the demonstration: one model, the Gare do Oriente, as a picture, a web page, an OpenSCAD program and a mesh to print.
# A file that cannot be made (a page, when npm could not fetch the viewer) is reported by vs; the others are made all the same, and the exit code is vs's.
set -u
vs=$1
mkdir -p out
name=gare-do-oriente status=0
"$vs" examples/$name.vs -o out/$name.png -o out/$name.html -o out/$name.scad -o out/$name.stl || status=$?
tell() { [ ! -f "out/$name.$1" ] || printf '  out/%-22s %s\n' "$name.$1" "$2"; }
echo
echo "Made from examples/$name.vs:"
tell png "the picture"
tell html "open it in a browser and turn the model"
tell scad "open it in OpenSCAD"
tell stl "a closed mesh, ready to print"
exit $status
