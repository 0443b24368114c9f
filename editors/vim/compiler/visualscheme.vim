" Owns :make for VisualScheme: FILE:LINE:COLUMN: message.
if exists("current_compiler")
  finish
endif
let current_compiler = "visualscheme"
CompilerSet makeprg=vs\ --quiet\ --check\ %:S
CompilerSet errorformat=%f:%l:%c:\ %tarning:\ %m,%f:%l:%c:\ %m,%-G%.%#
