% Registers belong to the nearest braces with usereg, and outlive them in the procedures made there.
/adder { usereg !n { :n add } } def
5 3 adder exec print
usereg 7 !n 1 2 adder pop pop :n print
% dictionaries with paths, and .member of what is on the stack
/A dict def A begin /B dict def B begin /two { 2 } def /list [ 4 5 6 ] def end end
A.B.two A.B.list length A .B .two add add print
/two where { pop "there" } { "nowhere" } ifelse print
A.B begin /two where { /two known { "known" } { "not" } ifelse } { "nowhere" } ifelse print end
% arrays: the same one is changed, and procedures are arrays of tokens
[ 1 2 ] dup 3 append pop == 
[ 1 2 3 4 ] dup -1 get exch dup 0 99 put == print
{ 1 2 add } cvlit length print
[ 2 3 /add load ] cvx exec print
[ [ 1 2 ] [ 3 ] 4 ] flatten == [ 1 2 3 ] reverse == [ 3 1 2 ] { dup mul } map ==
[ 1 2 3 ] [ 4 5 6 ] { mul } twomap ==
% the stack
clear 1 2 3 3 1 roll count print [ 4 5 counttomark exch pop exch pop print pop
clear 10 20 30 2 index print 3 -1 roll print clear
% loops
1 1 4 { 10 mul print } for
0.0 0.1 0.3 { pop (1,2) 2 mul print } forx
0 { 1 add dup 5 eq { exit } if } loop print
3 { 2 { "x" pop } repeat "y" print } repeat
0 !i { :i 3 lt } { :i 1 add !i } while :i print
% control and exceptions
1 2 lt { "less" } { "more" } ifelse print  4 5 1 ifpop print
{ 1 throw "never" print } { "caught" print } catch pop
% vectors
(1,2,3) (4,5,6) add print (1,2,3) (4,5,6) mul print (1,0,0) (0,1,0) cross print (3,4,0) abs print
(1,0,0) (0,0,1) 90 rot_vec 1e9 mul dup getX round 1e9 div exch getY round 1e9 div print print
30 sin 1e12 mul round 1e12 div print 60 cos 1e12 mul round 1e12 div print 1 1 atan2 print
[ (1,1,5) (2,1,5) ] (0,0,1) (0,0,1) -1 project_polyplane == (5,5,0) (0,0,0) (1,0,0) project_ptline print
7 2 div print 7 2 idiv print 7 3 mod print -7 3 mod print 2 10 pow print
"text" " and more" concat print count print
% so many steps at once; another way round is the rest of them
(0,0,0) (0,0,1) 1 8 circle 3 poly2doubleface dup 3 faceCCW exch 5 faceCW eq print % 1
newmacro (9,0,0) (0,0,1) 1 4 circle 3 poly2doubleface (0,1,3) extrude dup 3 vertexCCW sameEdge print % 1
node-controller /answer 42 put node-controller /answer get print % 42
node-getroot node-controller /host known print % 0
node-getroot pop
/gmlcontext node-create dup (1,2,3) node-transform node-gettransform print % (1.0,2.0,3.0)
osg-getroot /gmlcontext node-create osg-ctxconvert dup /converted node-setname osg-addchild
/converted node-find node-getparent node-getname print % root
node-controller print
currentmacro deletemacro
