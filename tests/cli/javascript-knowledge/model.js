// How wide a step is.
var width = 42;
width = "Hello World";
/** Adds. */
function add(a, b) {
  var unused = 3;
  return a + b;
  print("never");
}
function list(define) { for (var i = 0; i < 3; i++) { var t = define * i; print(t); } return function (q) { return t + missing; }; }
/*@ check: allow unused-parameter */
function quiet(x) { return 1; }
function noisy(x) { return 1; }
var f = function g(n) { return n ? g(n - 1) : 0; };
print(add(1, 2, 3), list(3), quiet(1), noisy(2), f(3));
try { throw 1; } catch (e) { print(e); }
function v() { return arguments.length; }
print(v(1, 2, 3), add(1));
var o = { a: 1, print: 2 }; o.b = o.a; o["c"] += 1; delete o.a;
function nat(msg) { /*% (display msg) %*/ }
nat(1);
if (false) print(1);
function hoister() { if (width) { var inner = 1; function deep() { return inner; } } return deep(); }
hoister();
