// no node
// The listings of the Euclides paper.
/*@
euclides.suppress_warning_unreferenced_object.say;
*/
/**
This function writes a text message to
standard out. The parameter 'msg' will be
converted to a 'string', if necessary.
*/
function say(msg)
{
/*%
(display (string-append "native: " msg))
(newline)
%*/
}
say("hello");

function fibonacci(index) {
switch (index) {
case 0:
case 1:
return 1;
default:
return fibonacci(index-2)
+ fibonacci(index-1);
}
}
var fibs = fibonacci(21);
print(fibs);

var number = 42;
number = "Hello World";
print(number);

function add(a, b) {
return a + b;
}
var c = 19.0 + 23.0;
print(add(19, 23), add("a", "b"), c);

function choose(favoritelanguage) {
switch (favoritelanguage) {
case "Java":
io_stdout_write("Good choice!");
break;
case "C":
io_stdout_write("Bad choice");
break;
default:
io_stdout_write("I have no idea");
}
io_stdout_write("\n");
}
choose("Java"); choose("C"); choose("JavaScript");

var x;
print(typeof x);
x = true; print(typeof x);
x = 3.14159; print(typeof x);
x = "Hello World"; print(x[4]);
x = [true, false, "maybe"]; print(x[2]);
var o = {x: 1.0, y: 2.0, z: 42}; print(o.x, o.y, o.z, o.w);
function do_nothing() {}
x = do_nothing; print(x(), typeof x);
function foo(n) { return n; }
var foo_functor = foo; print(foo(3), foo_functor(3.0));

function read() { throw "Error: unable to read file."; }
try { read(); } catch (e) { print("caught " + e); } finally { print("finally"); }

var a = 1, b = 2;
if (a == b) { c = a; } else { c = b; }
print(c);
while (false) { }
do { } while (false);
for (var i=0; i<1; i++) { }
print(i);
var array = [10, 20, 30];
for (var k in array) print(k, array[k]);

x = 0;
var y = 0;
function bar() { return 3; }
function select(i) {
switch (i) {
case 0:
case 1:
case 2: x = 1;
case 4: x = 3;
case bar(): x = 2; break;
default: y = 5;
}
}
select(3); print(x, y);
select(7); print(x, y);
