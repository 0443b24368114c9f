# Asks OpenSCAD for the volumes and echoes of p1.scad to pN.scad, and prints the file `wanted`.
# sh ask.sh N
i=0
while [ $((i += 1)) -le "$1" ]; do
  rm -f out.off
  openscad -o out.off p$i.scad > /dev/null 2> heard
  awk -v number=$i '
    # The volume of an OFF file: the sum over the triangles of each face.
    FNR == NR { if (/^ECHO/) echo = echo $0 "\n"; next }
    /^OFF/ { for (i = 2; i <= NF; i++) head[++n] = $i; next }
    n < 3 { for (i = 1; i <= NF && n < 3; i++) head[++n] = $i; next }
    NF && points + 0 < head[1] { x[points + 0] = $1; y[points + 0] = $2; z[points++] = $3; next }
    NF { a = $2
         for (k = 3; k < $1 + 1; k++) { b = $k; c = $(k + 1)
           sum += x[a] * (y[b] * z[c] - z[b] * y[c]) - y[a] * (x[b] * z[c] - z[b] * x[c]) + z[a] * (x[b] * y[c] - y[b] * x[c]) } }
    END { printf "= %d %.7g\n%s", number, sum / 6, echo }' heard $([ -f out.off ] && echo out.off)
done
