// Contains small helpers for elements. Text is always set as text: no text of a user is read as HTML.
export function el(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "class") node.className = value;
    else if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    // This sets a property, because the content security policy of the live view allows no style attributes.
    else if (key === "style") { if (value) node.style.cssText = value; }
    else if (value === true) node.setAttribute(key, "");
    else if (value !== false && value !== null && value !== undefined) node.setAttribute(key, value);
  }
  for (const child of children.flat(Infinity)) if (child !== null && child !== undefined) node.append(child);
  return node;
}

export function svg(name, attributes = {}, text) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

const ICONS = {
  fit: "M4 9V5a1 1 0 0 1 1-1h4M15 4h4a1 1 0 0 1 1 1v4M20 15v4a1 1 0 0 1-1 1h-4M9 20H5a1 1 0 0 1-1-1v-4M9 9h6v6H9z",
  views: "M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9",
  parallel: "M5 5h14v14H5zM5 12h14M12 5v14",
  walk: "M13 4.5a1 1 0 1 0 .01 0M8 21l2.5-5-1-3.5L11 8.5l3 2 3 .7M10 12l-3 1.5-.5-3L11 8.5M12.5 14.5L15 17l1 4",
  section: "M3 17l9 4 9-4M3 12l9 4 9-4M12 3v8M9 6l3-3 3 3",
  measure: "M3 16L16 3l5 5L8 21zM7 12l2 2M10 9l2.5 2.5M13 6l2 2",
  display: "M12 4v2M12 18v2M4 12h2M18 12h2M6.3 6.3l1.4 1.4M16.3 16.3l1.4 1.4M6.3 17.7l1.4-1.4M16.3 7.7l1.4-1.4M12 8.5a3.5 3.5 0 1 0 .01 0",
  panel: "M4 6h10M4 12h10M4 18h10M18 5v2M18 11v2M18 17v2M17.9 6h.2M17.9 12h.2M17.9 18h.2",
  help: "M12 20.5a8.5 8.5 0 1 0-.01 0M9.7 9.4a2.4 2.4 0 1 1 3.4 2.2c-.8.4-1.1.9-1.1 1.8M12 16.6v.01",
  close: "M7 7l10 10M17 7L7 17",
  steps: "M4 18h4v-4h4v-4h4V6h4M4 18v2h16",
  play: "M8 5.5v13l11-6.5z",
  back: "M18 6v12L9 12zM6 6v12",
  on: "M6 6v12l9-6zM18 6v12",
  fold: "M20 5v14M15 8l-4 4 4 4M11 12h-7",
  unfold: "M4 5v14M9 8l4 4-4 4M13 12h7",
  flip: "M7 4v16M4 7l3-3 3 3M17 20V4M14 17l3 3 3-3",
};
export function icon(name) {
  const s = svg("svg", { viewBox: "0 0 24 24", class: "icon", "aria-hidden": "true" });
  s.append(svg("path", { d: ICONS[name] }));
  return s;
}
