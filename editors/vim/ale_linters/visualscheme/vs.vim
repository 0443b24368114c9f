" Owns the language server for the plugin ALE.
call ale#linter#Define('visualscheme', {
\ 'name': 'vs', 'lsp': 'stdio', 'executable': 'vs', 'command': '%e lsp', 'language': 'visualscheme',
\ 'project_root': {buffer -> expand('#' . buffer . ':p:h')}})
