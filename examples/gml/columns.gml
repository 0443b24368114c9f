% A row of Doric columns: the program of listing 2.2 of the VisualScheme thesis, in the Generative Modeling Language.
%
% What it teaches: libraries are dictionaries (Columns.Config, Columns.Tools) that are opened with begin and closed with end; procedures
% take their arguments from the stack into registers. Shaft and capital are one procedure with other numbers. The columns grow along -Y,
% as the listing has them.
%
%   vs columns.gml -o columns.png
/Columns dict def
Columns begin
  /Config dict def
  Config begin
    /divisions 64 def
    /material /concrete def
  end
  /cut-cone {
    Columns.Config begin
      usereg !top-r !base-r !height
      material setcurrentmaterial
      (0,-1,0) :base-r divisions circle
      3 poly2doubleface
      :base-r :top-r sub :height 3 vector3
      extrude
    end
  } def
  /shaft { cut-cone } def
  /capital { cut-cone } def
  /Tools dict def
  /abacus {
    Columns.Tools begin
      usereg !length !height !p
      :length 2.0 div !l2
      :length -2.0 div !l-2
      :l-2 0 :l-2 vector3 :p add
      :l2 0 :l2 vector3 :p add
      3 quad 3 poly2doubleface
      0 :height neg 3 vector3
      extrude
    end
  } def
  /column {
    usereg
    !a-l !a-h !c-b-r !c-h !s-b-r !s-h !p
    :p
    :s-h :s-b-r :c-b-r shaft
    0 :s-h neg 0 vector3 :p add
    :c-h :c-b-r :a-l 2.0 div capital
    0 :s-h :c-h add neg 0 vector3 :p add
    :a-h :a-l abacus
  } def
end
deleteallmacros newmacro
clear
Columns begin
  (0,0,0) 9 0.5 0.4 0.3 0.3 1.0 column
  (3,0,0) 7 0.5 0.4 0.6 0.6 1.6 column
  (6,0,0) 9 0.7 0.5 0.3 0.2 1.2 column
  (9,0,0) 8 0.4 0.3 0.2 0.3 1.0 column
  (12,0,0) 5 0.5 0.4 0.3 0.1 1.0 column
  (15,0,0) 6 0.8 0.3 0.2 0.4 1.4 column
end
