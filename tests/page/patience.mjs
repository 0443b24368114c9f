// Lengthens limits of elapsed time by the machine's load, as tests/patience.py does.
import { availableParallelism, loadavg } from "node:os";

const MOST = 4; // A late end must not pass as a busy machine.

// Returns the limit in ms on this machine now; `ms` is that of an idle one.
export const patience = (ms) => ms * Math.min(MOST, Math.max(1, loadavg()[0] / availableParallelism()));
