try { throw "a"; } catch (e) { print("caught", e); }
try { null.x; } catch (e) { print(e instanceof TypeError, e.name, e.message); }
try { undefined.foo.bar; } catch (e) { print(e.message); }
try { var u; u.x = 1; } catch (e) { print(e.message); }
try { nope; } catch (e) { print(e.name, e.message, e instanceof ReferenceError); }
try { nope(); } catch (e) { print(e.name, e.message); }
try { var f = 5; f(); } catch (e) { print(e.name, e.message); }
try { ({}).m(); } catch (e) { print(e.name); }
try { throw new Error("msg"); } catch (e) { print(e, e.message, e.name, e instanceof Error); }
try { throw new RangeError("r"); } catch (e) { print(e, e instanceof Error, e instanceof TypeError); }
try { throw { code: 7 }; } catch (e) { print(e.code); }
function fin(k) { try { if (k == 0) return "ret"; if (k == 1) throw "thr"; if (k == 2) return "two"; } catch (e) { return "c" + e; } finally { print("finally", k); } return "end"; }
print(fin(0), fin(1), fin(2), fin(3));
function over() { try { return 1; } finally { return 2; } } print(over());
function over2() { try { throw 1; } finally { return 3; } } print(over2());
function over3() { for (var i = 0; i < 3; i++) { try { if (i == 1) continue; if (i == 2) break; print("body", i); } finally { print("f", i); } } return "done" + i; } print(over3());
function rethrow() { try { try { throw "x"; } catch (e) { throw e + "y"; } finally { print("inner f"); } } catch (e2) { return e2; } } print(rethrow());
function inloop() { var r = ""; for (var i = 0; i < 5; i++) { try { if (i == 1) throw i; if (i == 3) return r + "ret"; r += i; } catch (e) { r += "e" + e; continue; } r += "|"; } return r; } print(inloop());
function lab() { out: for (var i = 0; i < 3; i++) for (var j = 0; j < 3; j++) { try { if (j == 1) continue out; if (i == 2) break out; print(i, j); } finally { print("f", i, j); } } } lab();
var e = "outer"; try { throw "inner"; } catch (e) { print(e); e = "changed"; } print(e);
try { (function () { throw new TypeError("deep"); })(); } catch (x) { print(x.name + ": " + x.message); }
function nestfin() { try { try { return "a"; } finally { print("f1"); } } finally { print("f2"); } } print(nestfin());
function fw() { while (true) { try { return "w"; } finally { break; } } return "broke"; } print(fw());
try { try { throw 1; } finally { print("passing"); } } catch (e) { print("got", e); }
function swf(n) { switch (n) { case 1: try { break; } finally { print("sf"); } default: return "dflt"; } return "after"; } print(swf(1), swf(2));
function MyErr(m) { this.message = m; } MyErr.prototype = new Error(); MyErr.prototype.name = "MyErr"; try { throw new MyErr("mine"); } catch (e) { print(e instanceof MyErr, e instanceof Error, e.name, e.message, "" + e); }
try { new 5; } catch (e) { print(e.name); } try { [].reduce(function () {}); } catch (e) { print(e.name, e.message); } try { (1).toFixed(200); } catch (e) { print(e.name); } try { new Array(-1); } catch (e) { print(e.name, e.message); } try { 1 in "a"; } catch (e) { print(e.name); } try { ({}) instanceof 5; } catch (e) { print(e.name); }
function three() { var log = []; for (var i = 0; i < 4; i++) { try { try { if (i == 0) throw "a"; if (i == 1) continue; if (i == 2) break; } finally { log.push("x" + i); } } catch (e) { log.push("c" + e); } } return log.join(); } print(three());
var cnt = 0; function sidee() { return cnt++; } try { undefined[sidee()]; } catch (e) { print(cnt); }
try { throw undefined; } catch (e) { print(e, typeof e); } try { throw null; } catch (e) { print(e); }
function g() { try { h(); } catch (e) { return "g:" + e; } } function h() { try { throw "1"; } finally { k(); } } function k() { print("k"); } print(g());
