// Numbers that a reader sets: by a slider, or typed within wider bounds.

const rich = (text) => text.split("*").map((piece, i) => (i % 2 ? make("em", {}, piece) : piece));
const said = (number) => number.toLocaleString("en", { maximumSignificantDigits: 4 });
const tall = (height) => (innerWidth < 640 ? 0.72 * height : height);

const PAUSE = 300; // milliseconds

/**
 * A slider and a field for typing. With `stops` the slider goes from one of these numbers to the
 * next; what is typed may lie between them.
 */
function field({ name, title, unit = "", slider, stops, step, whole = false, bounds, value }, changed) {
  const nearest = (own) => stops.reduce((best, stop, i) => (Math.abs(stop - own) < Math.abs(stops[best] - own) ? i : best), 0);
  const [at, own] = stops ? [nearest, (range) => stops[range.value]] : [(own) => own, (range) => range.value];
  const [low, high] = stops ? [0, stops.length - 1] : slider;
  const range = make("input", { type: "range", id: `lab-${name}`, min: low, max: high, step: stops ? 1 : step, value: at(value) });
  const typed = make("input", { type: "number", min: bounds[0], max: bounds[1], step: whole ? 1 : "any", value });
  typed.setAttribute("aria-label", `${title.replaceAll("*", "")}, typed`);
  const tell = () => stops && range.setAttribute("aria-valuetext", typed.value);
  const node = make("div", {}, make("label", { htmlFor: range.id }, ...rich(unit ? `${title} (${unit})` : title)), range, typed);
  // What is typed counts after a pause, or when it is left or entered.
  let waiting;
  const settle = () => (clearTimeout(waiting), (waiting = undefined), changed());
  range.addEventListener("input", () => ((typed.value = own(range)), tell(), settle()));
  typed.addEventListener("input", () => {
    range.value = at(typed.value);
    tell();
    clearTimeout(waiting);
    waiting = setTimeout(settle, PAUSE);
  });
  typed.addEventListener("change", () => waiting && settle());
  tell();
  return {
    node,
    get() {
      const own = typed.valueAsNumber;
      if (own >= bounds[0] && own <= bounds[1] && (!whole || Number.isInteger(own))) return own;
      throw new RangeError(`${title.replaceAll("*", "")} = ${typed.value || "nothing"} is not allowed; give a ${whole ? "whole " : ""}number from ${bounds[0]} to ${bounds[1]}.`);
    },
    set(own) {
      clearTimeout(waiting);
      waiting = undefined;
      typed.value = own;
      range.value = at(own);
      tell();
    },
  };
}

function fields(list, changed) {
  const all = Object.fromEntries(list.map((one) => [one.name, field(one, changed)]));
  return {
    node: make("div", { className: "fields" }, ...Object.values(all).map((one) => one.node)),
    get: () => Object.fromEntries(Object.entries(all).map(([name, one]) => [name, one.get()])),
    set: (values) => Object.entries(values).forEach(([name, value]) => all[name]?.set(value)),
  };
}

/** What each line, band or mark of a picture means: a colour, words, and a kind of line or mark. */
const key = (name, text, kind = "", strength = 1) => {
  const node = make("span", { className: `key ${kind}` }, ...rich(text));
  node.style.setProperty("--of", `color-mix(in srgb, var(--${name}) ${100 * strength}%, var(--page))`);
  return node;
};
const keys = (...names) => make("p", {}, ...names.map((one) => key(...one)));

/** A button that says what it does. */
const button = (textContent, click) => {
  const node = make("button", { type: "button", textContent });
  node.addEventListener("click", click);
  return node;
};
