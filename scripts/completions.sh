#!/bin/sh
# Prints the completion of the command for a shell: the file for SHELL, made from cli/options.def and cli/commands.def.
#
#   scripts/completions.sh bash|zsh|fish
#
# The row of an option decides its completions: words between | are the choices, OUT is a file, DIR a folder; other
# arguments get none.
set -u
cd "$(dirname "$0")/.." || exit 1
pages=$(for page in manual/*.md manual/language/*.md manual/primitives/*.md manual/rules/*.md; do basename "$page" .md; done | grep -v README | sort -u | tr '\n' ' ')

# The table's rows, each on one line.
rows() { sed -e ':again' -e '/^\(COMMAND\|OPTION\)(.*,$/{N;s/\n */ /;b again' -e '}' "$@"; }
case ${1:-} in bash | zsh | fish) ;; *) echo "usage: $0 bash|zsh|fish" >&2; exit 2 ;; esac
rows cli/options.def cli/commands.def | awk -F '"' -v shell="$1" -v pages="${pages% }" '
  function quoted(s) { gsub(/\047/, "\047\\\047\047", s); return "\047" s "\047" } # for a shell
  function plain(s) { gsub(/[\[\]:\\]/, "\\\\&", s); gsub(/\047/, "\047\\\047\047", s); return s } # within a specification of zsh
  function words(value) { gsub(/\|/, " ", value); return value }
  /^OPTION\(/ {
    n++
    match($1, /\047.\047/); letter[n] = RSTART ? substr($1, RSTART + 1, 1) : ""
    long[n] = $2; value[n] = $4; help[n] = $6
    rule[n] = $3 ~ /NONE/ ? "none" : $3 ~ /OPTIONAL/ ? "optional" : "required"
    what[n] = rule[n] == "none" ? "" : value[n] ~ /\|/ || value[n] ~ /^[a-z]+$/ ? "words" : value[n] == "OUT" ? "file" : value[n] == "DIR" ? "folder" : "value"
  }
  /^COMMAND\(/ { m++; name = $1; sub(/^COMMAND\(/, "", name); sub(/,.*/, "", name); command[m] = name; takes[m] = $2; does[m] = $4 }
  function names(i) { return (letter[i] != "" ? "-" letter[i] : "") (letter[i] != "" && long[i] != "" ? "|" : "") (long[i] != "" ? "--" long[i] : "") }

  function bash(   i, all, first) {
    for (i = 1; i <= n; i++) all = all (all == "" ? "" : " ") (letter[i] != "" ? "-" letter[i] " " : "") (long[i] != "" ? "--" long[i] : "")
    gsub(/ +/, " ", all)
    for (i = 1; i <= m; i++) first = first (i > 1 ? " " : "") command[i]
    print "# bash completion of vs; made by scripts/completions.sh"
    print "_vs() {"
    print "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} IFS=$\047\\n\047"
    print "  if [ \"$cur\" = = ]; then cur=; elif [ \"$prev\" = = ]; then prev=${COMP_WORDS[COMP_CWORD-2]}; fi"
    print "  COMPREPLY=()"
    print "  case $prev in"
    for (i = 1; i <= n; i++) {
      if (rule[i] == "none") continue
      if (rule[i] == "optional") { if (long[i] != "") print "    --" long[i] ") if [ \"${COMP_WORDS[COMP_CWORD]}\" = = ] || [ \"${COMP_WORDS[COMP_CWORD-1]}\" = = ]; then COMPREPLY=($(compgen -W \047" words(value[i]) "\047 -- \"$cur\")); return; fi ;;"; continue }
      if (what[i] == "words") act = "IFS=\047 \047; COMPREPLY=($(compgen -W \047" words(value[i]) "\047 -- \"$cur\")); return"
      else if (what[i] == "file") act = "compopt -o filenames 2> /dev/null; COMPREPLY=($(compgen -f -- \"$cur\")); return"
      else if (what[i] == "folder") act = "compopt -o filenames 2> /dev/null; COMPREPLY=($(compgen -d -- \"$cur\")); return"
      else act = "return"
      print "    " names(i) ") " act " ;;"
    }
    print "  esac"
    print "  if [ \"${COMP_WORDS[1]}\" = help ] && [ \"$COMP_CWORD\" -gt 1 ]; then"
    print "    IFS=\047 \047; COMPREPLY=($(compgen -W \047" pages "\047 -- \"$cur\"))"
    print "    return"
    print "  fi"
    print "  case $cur in"
    print "    -*) IFS=\047 \047; COMPREPLY=($(compgen -W \047" all "\047 -- \"$cur\")) ;;"
    print "    *)"
    print "      compopt -o filenames 2> /dev/null"
    print "      COMPREPLY=($(compgen -d -- \"$cur\") $(compgen -f -X \047!*.@(vs|scm|ss|gml|js|lsp|scad)\047 -- \"$cur\"))"
    print "      IFS=\047 \047; [ \"$COMP_CWORD\" != 1 ] || COMPREPLY+=($(compgen -W \047" first "\047 -- \"$cur\")) ;;"
    print "  esac"
    print "}"
    print "shopt -s extglob"
    print "complete -F _vs vs"
  }

  function zsh(   i, after, spec) {
    print "#compdef vs"
    print "# zsh completion of vs; made by scripts/completions.sh"
    print "_vs_first() {"
    print "  local -a commands=("
    for (i = 1; i <= m; i++) print "    " quoted(command[i] ":" does[i])
    print "  )"
    print "  _describe -t commands command commands"
    print "  _files -g \047*.(vs|scm|ss|gml|js|lsp|scad)\047"
    print "}"
    print "_vs_rest() {"
    print "  if [[ ${words[2]} == help ]]; then"
    print "    compadd -- " pages
    print "  else"
    print "    _files -g \047*.(vs|scm|ss|gml|js|lsp|scad)\047"
    print "  fi"
    print "}"
    print "_arguments -s \\"
    for (i = 1; i <= n; i++) {
      after = what[i] == "words" ? ":" tolower(long[i]) ":(" words(value[i]) ")" : what[i] == "file" ? ":file:_files" : what[i] == "folder" ? ":folder:_files -/" : what[i] == "value" ? ":" plain(value[i]) ": " : ""
      if (rule[i] == "optional") after = ":" after
      spec = "[" plain(help[i]) "]" after
      if (letter[i] != "") print "  \047*-" letter[i] (rule[i] == "optional" ? "-" : rule[i] == "none" ? "" : "+") spec "\047 \\"
      if (long[i] != "") print "  \047*--" long[i] (rule[i] == "optional" ? "=-" : rule[i] == "none" ? "" : "=") spec "\047 \\"
    }
    print "  \0471:file or command:_vs_first\047 \\"
    print "  \047*:file:_vs_rest\047"
  }

  function fish(   i, line) {
    print "# fish completion of vs; made by scripts/completions.sh"
    for (i = 1; i <= n; i++) {
      line = "complete -c vs" (letter[i] != "" ? " -s " letter[i] : "") (long[i] != "" ? " -l " long[i] : "")
      if (rule[i] == "required") line = line (what[i] == "file" ? " -r" : what[i] == "folder" ? " -x -a \047(__fish_complete_directories)\047" : what[i] == "words" ? " -x -a " quoted(words(value[i])) : " -x")
      else if (rule[i] == "optional" && what[i] == "words") line = line " -a " quoted(words(value[i]))
      text = help[i]; gsub(/\\/, "\\\\", text); gsub(/\047/, "\\\047", text)
      print line " -d \047" text "\047"
    }
    for (i = 1; i <= m; i++) print "complete -c vs -n __fish_use_subcommand -a " command[i] " -d " quoted(does[i])
    print "complete -c vs -n \047__fish_seen_subcommand_from help\047 -f -a " quoted(pages)
  }
  END { if (shell == "bash") bash(); else if (shell == "zsh") zsh(); else fish() }'
