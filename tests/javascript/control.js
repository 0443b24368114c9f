var x = 0, y = 0;
function bar() { return 3; }
function foo(i) {
switch(i) {
case 0:
case 1:
case 2: x = 1;
case 4: x = 3;
case bar(): x = 2; break;
default: y = 5;
}
}
foo(3); print(x, y);
x = y = 0; foo(0); print(x, y);
x = y = 0; foo(9); print(x, y);
x = y = 0; foo(4); print(x, y);
function g(n) { for (var i = 0; i < 10; i++) { if (i == n) return "at " + i; if (i % 2) continue; x += i; } return "end"; }
print(g(5), x, g(100), x);
function lab() { var s = ""; outer: for (var i = 0; i < 4; i++) { for (var j = 0; j < 4; j++) { if (j == 2) continue outer; if (i == 3) break outer; s += i + "" + j + " "; } } return s; }
print(lab());
blk: { print("in"); if (x > 0) break blk; print("not here"); }
var i = 0; do { i++; if (i == 3) continue; if (i > 5) break; print("do", i); } while (i < 10);
print(i);
while (true) { if (--i < 2) break; }
print(i);
for (;;) { i++; if (i > 7) break; }
print(i);
for (var k = 0, m = 10; k < m; k++, m--); print(k, m);
function sw(v) { switch (typeof v) { case "number": return "n"; case "string": return "s"; default: return "d"; case "boolean": return "b"; } }
print(sw(1), sw("a"), sw(true), sw(null));
function dmid(v) { var s = ""; switch (v) { case 1: s += "1"; default: s += "d"; case 2: s += "2"; break; case 3: s += "3"; } return s; }
print(dmid(1), dmid(2), dmid(3), dmid(4));
function nested(a, b) { switch (a) { case 1: switch (b) { case 1: return "11"; case 2: break; default: return "1x"; } return "12"; case 2: for (;;) { switch (b) { case 5: break; } break; } return "2"; } return "none"; }
print(nested(1,1), nested(1,2), nested(1,3), nested(2,5), nested(3,3));
function sw2(n) { var r = []; for (var i = 0; i < n; i++) { switch (i) { case 1: continue; case 3: break; default: r.push(i); } r.push("e" + i); } return r.join(); }
print(sw2(5));
