/box { /std9hi setcurrentmaterial (0,0,0) (0,0,1) 1 4 circle 3 poly2doubleface (0,1,3) extrude pop } def
/gmlcontext node-create !n
node-getroot :n node-addchild
:n node-begin box node-end
"local" node-find node-begin box node-end
