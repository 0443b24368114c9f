// Contains the notation of lengths and areas on the page.

// Returns a number with digits that suit its size, and its unit.
export function length(x, units) {
  const a = Math.abs(x), digits = a >= 1000 ? 0 : a >= 100 ? 1 : a >= 1 ? 2 : 4;
  return Number(x.toFixed(digits)).toLocaleString("en", { maximumFractionDigits: digits, useGrouping: false }) + (units ? " " + units : "");
}
