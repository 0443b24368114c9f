// Contains the notation of lengths and areas on the page, and round steps.

// Returns a number with digits that suit its size, and its unit.
export function length(x, units) {
  const a = Math.abs(x), digits = a >= 1000 ? 0 : a >= 100 ? 1 : a >= 1 ? 2 : 4;
  return Number(x.toFixed(digits)).toLocaleString("en", { maximumFractionDigits: digits, useGrouping: false }) + (units ? " " + units : "");
}

// Returns the step of 1, 2 or 5 times a power of ten that is nearest to a length.
export function roundStep(rough) {
  const power = 10 ** Math.floor(Math.log10(rough)), least = rough / power;
  return power * (least < 1.5 ? 1 : least < 3.5 ? 2 : least < 7.5 ? 5 : 10);
}
