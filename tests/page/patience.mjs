// Lengthens a limit of elapsed time by the machine's load: what one of two cores does in a second takes five at load 10.
import { availableParallelism, loadavg } from "node:os";

// Returns the limit in ms on this machine now; `ms` is that of an idle one.
export const patience = (ms) => ms * Math.max(1, loadavg()[0] / availableParallelism());
