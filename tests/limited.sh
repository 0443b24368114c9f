# Defines the limits of the tests: `limited SECONDS COMMAND...` ends the command when one of its processes has used SECONDS
# of processor time, however busy the machine is. A process that only waits ends after ten times as much elapsed time.
limited() (ulimit -t "$1"; clock=$((10 * $1)); shift; exec timeout "$clock" "$@")

