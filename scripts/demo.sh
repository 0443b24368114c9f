#!/bin/sh
# Owns the demonstration: one model, the Gare do Oriente, as a picture, a web page, an OpenSCAD program and a mesh to print.
set -eu
vs=$1
mkdir -p out
name=gare-do-oriente
"$vs" examples/$name.vs -o out/$name.png -o out/$name.html -o out/$name.scad -o out/$name.stl
echo
echo "Made from examples/$name.vs:"
echo "  out/$name.png   the picture"
echo "  out/$name.html  open it in a browser and turn the model"
echo "  out/$name.scad  open it in OpenSCAD"
echo "  out/$name.stl   a closed mesh, ready to print"
