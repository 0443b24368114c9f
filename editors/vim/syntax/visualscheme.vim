" Owns the colours: Scheme's, and the language's own words.
if exists("b:current_syntax")
  finish
endif
runtime! syntax/scheme.vim
unlet! b:current_syntax
syn keyword vsForm define-parameter define-primitive register-drawing-function
syn match vsOperation /\v[(\[]@<=(draw|unite|intersect|subtract|with-material|color|layer|highlight|ghost|only|hull|camera|sun|sky|fog|ground|units)>/
syn match vsMake /\v[(\[]@<=(make|do)-[a-z0-9*-]+/
syn match vsKeyword /#:[a-z0-9-]\+/
syn cluster schemeBaseListCluster add=vsForm,vsOperation,vsMake,vsKeyword
syn cluster schemeListCluster add=vsForm,vsOperation,vsMake,vsKeyword
hi def link vsForm Statement
hi def link vsOperation Function
hi def link vsMake Function
hi def link vsKeyword Identifier
let b:current_syntax = "visualscheme"
