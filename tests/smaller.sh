# Lists the parameters that make an example small which would take minutes in all formats, for tests that write every
# example several times. Copies, twists and holes stay; the test of passes omits them.
smaller() { # EXAMPLE
  case $1 in
  examples/city.vs) echo "-D blocks=3 -D tallest=8" ;;
  examples/gare-do-oriente.vs) echo "-D columns=2 -D rows=2" ;;
  examples/thesis/5.5-gare.vs) echo "-D x=2 -D y=1" ;;
  examples/panelised-roof.vs) echo "-D nu=4 -D nv=4" ;;
  examples/diagrid-roof.vs) echo "-D across=3 -D along=4" ;;
  examples/diagrid-tower.vs) echo "-D storeys=8 -D sides=8" ;;
  examples/gare-analysed.vs) echo "-D columns=1 -D rows=1" ;;
  examples/school-plan.vs) echo "-D classes=2" ;;
  examples/deformed-tower.vs) echo "-D storeys=8" ;;
  examples/rules/massive-street.vs) echo "-D lots=3" ;;
  esac
}
