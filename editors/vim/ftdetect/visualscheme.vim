autocmd BufNewFile,BufRead *.vs setlocal filetype=visualscheme
