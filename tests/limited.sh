# Owns the limits of what tests run: `limited SECONDS COMMAND...` ends the command when one of its processes has had so much processor time, however busy
# the machine is. What waits without working ends after ten times as long by the clock.
limited() (ulimit -t "$1"; clock=$((10 * $1)); shift; exec timeout "$clock" "$@")
