" Owns what a VisualScheme buffer can do.
if exists("b:did_ftplugin")
  finish
endif
runtime! ftplugin/scheme.vim
let b:did_ftplugin = 1
setlocal lisp expandtab commentstring=;%s
setlocal lispwords+=define-parameter,define-primitive,with-material,layer,color,lambda,let,let*,letrec,when,unless,guard,parameterize,receive
setlocal lispwords+=let-values,let*-values,let/cc,let/ec,for,for*,for/list,for*/list,for/vector,for/sum,for*/sum,for/and,for/or,for/fold
compiler visualscheme
command! -buffer VsCheck call setqflist([], "r", {"title": "vs check", "lines": systemlist("vs check " . shellescape(expand("%"))), "efm": &l:errorformat})
command! -buffer VsView call job_start(["vs", "view", expand("%:p")])
command! -buffer -nargs=1 -complete=file VsWrite execute "!vs" shellescape(expand("%")) "-o" shellescape(<q-args>)
