" Owns an hour of editing with ALE: runs each line of the file `steps`, and then waits until its text was compared with the
" server's.
set hidden nobackup noswapfile noautoindent nosmartindent noexpandtab encoding=utf-8 fileencoding=utf-8 indentexpr= undolevels=1000
let g:ale_lint_on_text_changed = 'never'
let g:ale_lint_on_insert_leave = 0
let g:ale_completion_enabled = 0
let g:ale_set_signs = 0
let g:ale_set_highlights = 0
let g:ale_echo_cursor = 0
let s:done = 0
let s:folder = getcwd()
let s:asked = []

function! s:Wait(Test) abort
  let tries = 0
  while !a:Test() && tries < 12000
    sleep 5m
    let tries += 1
  endwhile
  if !a:Test()
    call writefile(['waited too long at step ' . s:done], '/dev/stderr')
    cquit
  endif
endfunction

function! s:Compared() abort
  let file = s:folder . '/compared'
  return filereadable(file) && join(readfile(file), '') == string(s:done)
endfunction

" The text as ALE sends it: its lines, each with its end.
function! s:Compare() abort
  call s:Send()
  let s:done += 1
  call writefile([expand('%:p')] + getline(1, '$') , s:folder . '/step.part')
  call rename(s:folder . '/step.part', s:folder . '/step')
  call s:Wait(function('s:Compared'))
endfunction

function! s:Linter() abort
  return ale#linter#Get('visualscheme')[0]
endfunction

" Sends the changes of the text, and opens it first if the server does not have it.
function! s:Send() abort
  let s:ready = 0
  call ale#lsp_linter#StartLSP(bufnr(''), s:Linter(), {linter, details -> s:Ready(details)})
  call s:Wait({-> s:ready})
endfunction

function! s:Ready(details) abort
  let s:ready = 1
  let s:connection = a:details.connection_id
  call ale#lsp#NotifyForChanges(a:details.connection_id, bufnr(''))
endfunction

function! s:Heard(id, response) abort
  if has_key(a:response, 'id') && a:response.id == s:wanted
    let s:heard = a:response
  endif
endfunction

" The response to a request about the place of the cursor.
function! s:Ask(method, more) abort
  call s:Send()
  let s:heard = {}
  call ale#lsp#RegisterCallback(s:connection, function('s:Heard'))
  let position = {'line': line('.') - 1, 'character': strchars(substitute(strpart(getline('.'), 0, col('.') - 1), '[^\x00-\uFFFF]', 'xx', 'g'))}
  let s:wanted = ale#lsp#Send(s:connection, [0, a:method, extend({'textDocument': {'uri': ale#util#ToURI(expand('%:p'))}, 'position': position}, a:more)])
  call s:Wait({-> !empty(s:heard)})
  return get(s:heard, 'result', v:null)
endfunction

function! s:Go(at) abort
  execute 'goto ' . (1 + float2nr(a:at * (line2byte('$') + len(getline('$')) - 1)))
endfunction

function! s:Word(word) abort
  call cursor(1, 1)
  return search('\V' . escape(a:word, '\'), 'c') > 0
endfunction

function! s:Apply(edit) abort
  if type(a:edit) == v:t_dict && !empty(get(a:edit, 'changes', {}))
    call ale#code_action#HandleCodeAction({'description': 'edit', 'changes': ale#code_action#BuildChangesList(a:edit.changes)}, {})
  endif
endfunction

function! s:Complete(prefix) abort
  call append('$', '(' . a:prefix)
  call cursor(line('$'), len(getline('$')) + 1)
  let items = s:Ask('textDocument/completion', {'position': {'line': line('$') - 1, 'character': len(a:prefix) + 1}})
  if type(items) == v:t_list && !empty(items)
    call setline('$', '(' . items[0].textEdit.newText)
  endif
  call setline('$', getline('$') . ')')
endfunction

function! s:Step(step) abort
  let word = a:step[0]
  if word ==# 'type'
    call s:Go(a:step[1])
    let @z = a:step[2]
    normal! "zP
  elseif word ==# 'form'
    call s:Go(a:step[1])
    call search('^(draw')
    call append(line('.') - 1, split(a:step[2], "\n"))
  elseif word ==# 'all'
    call deletebufline('', 1, '$')
    call setline(1, split(a:step[1], "\n"))
  elseif word ==# 'delete'
    call s:Go(a:step[1])
    execute 'normal! ' . a:step[2] . 'x'
  elseif word ==# 'line'
    call s:Go(a:step[1])
    normal! ddp
  elseif word ==# 'replace'
    execute 'silent! keeppatterns %s/\V' . a:step[1] . '/' . a:step[2] . '/g'
  elseif word ==# 'undo'
    execute 'silent! normal! ' . a:step[1] . 'u'
  elseif word ==# 'complete'
    call s:Complete(a:step[1])
  elseif word ==# 'hover' || word ==# 'definition' || word ==# 'references'
    if s:Word(a:step[1])
      call s:Ask('textDocument/' . word, word ==# 'references' ? {'context': {'includeDeclaration': v:true}} : {})
    endif
  elseif word ==# 'rename'
    if s:Word(a:step[1])
      call s:Apply(s:Ask('textDocument/rename', {'newName': a:step[2]}))
    endif
  elseif word ==# 'outline'
    call s:Ask('textDocument/documentSymbol', {})
  elseif word ==# 'action'
    let actions = s:Ask('textDocument/codeAction', {'range': {'start': {'line': 0, 'character': 0}, 'end': {'line': line('$'), 'character': 0}}, 'context': {'diagnostics': []}})
    if type(actions) == v:t_list && !empty(actions)
      call s:Apply(get(actions[0], 'edit', {}))
    endif
  elseif word ==# 'format'
    let edits = s:Ask('textDocument/formatting', {'options': {}})
    if type(edits) == v:t_list && !empty(edits)
      let [cursor, text] = [getpos('.'), edits[0].newText]
      call deletebufline('', 1, '$')
      call setline(1, split(substitute(text, '\n$', '', ''), "\n", 1))
    endif
  elseif word ==# 'save'
    silent write
  elseif word ==# 'other'
    execute 'silent edit ' . (expand('%:t') ==# 'one.vs' ? 'two.vs' : 'one.vs')
  else
    cquit
  endif
endfunction

silent edit one.vs
for s:line in readfile('steps')
  let &l:undolevels = &l:undolevels
  call s:Step(map(split(s:line, "\t"), {_, word -> json_decode(word)}))
  call s:Compare()
endfor
call ale#lsp#Send(s:connection, [0, 'shutdown'])
call ale#lsp#Send(s:connection, [1, 'exit'])
sleep 500m
qa!
