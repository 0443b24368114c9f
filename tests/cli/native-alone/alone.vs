(draw (native 'povray "sphere { 0, 1 }"))
