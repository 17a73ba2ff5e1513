// A figure says what it shows where one points, or goes with the arrow keys: series, place, value
// and interval, from its data.

const NEAR = 500; // in units of the drawing
const digits = (text) => (text === "" ? "" : Number(Number(text).toPrecision(4)).toString().replace("-", "\u2212"));

/** A value and its error: one digit of the error, two after a leading one, and as many of the value. */
function with_error(value, error) {
  const size = Number(error);
  if (!(size > 0)) return [digits(value), digits(error)];
  const leading = Math.floor(Math.log10(size));
  const decimals = Math.max(0, (size < 1.95 * 10 ** leading ? 1 : 0) - leading);
  return [value, error].map((text) => Number(text).toFixed(decimals).replace("-", "\u2212"));
}

/** Rows of a CSV file, whose fields may be quoted. */
const cells = (line) => [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)].map(([, quoted, bare]) => quoted?.replaceAll('""', '"') ?? bare);

/** The name of a column with its unit, as people write it. */
const named = (head) => head.replace(" (1)", "").replaceAll("sigma", "σ").replaceAll("omega", "ω").replace("^2", "²");

/** A function from data to the drawing, along one axis. */
function scale([low, high, is_log], from, to) {
  const of = is_log === "true" ? Math.log : Number;
  return (value) => from + ((to - from) * (of(value) - of(low))) / (of(high) - of(low));
}

/** All points of a figure that its panels show. */
function points_of(svg, files) {
  const rest = files.map((file) => file.trim().split("\n").map(cells));
  const words = all(".said", svg).filter((word) => /^\([a-z]\)$/.test(word.textContent));
  const letters = words.map((word) => [word.textContent, word.transform.baseVal.consolidate().matrix]);
  const panels = Map.groupBy(all(".data[data-axes]", svg), (group) => group.dataset.frame);
  return [...panels.values()].flatMap((groups) => {
    const names = new Set(groups.map((group) => group.dataset.name));
    const at = rest.findIndex(([, ...rows]) => rows.some(([series]) => names.has(series)));
    if (at < 0) return [];
    const [[head, ...rows]] = rest.splice(at, 1);
    const columns = head.map((name) => name.replace(/ \(.*/, ""));
    const column = (row, name) => row[columns.indexOf(name) - 1] ?? "";
    const [left, top, right, bottom] = groups[0].dataset.frame.split(" ").map(Number);
    const ends = groups[0].dataset.axes.split(" ");
    // The letter of a panel stands above its frame, or above one to the left.
    const above = letters.filter(([, { e, f }]) => e < left + NEAR && f < top && f > top - NEAR);
    const [letter] = above.toSorted(([, a], [, b]) => b.e - a.e)[0] ?? [];
    const panel = letter ? `${letter} ` : "";
    const [x, y] = [scale(ends.slice(0, 3), left, right), scale(ends.slice(3), bottom, top)];
    return rows.flatMap(([series, ...row]) => {
      const [of, value] = columns[2] === "low" ? [row[0], ""] : row;
      const [error, low, high] = ["standard_error", "low", "high"].map((name) => column(row, name));
      const [px, py] = [x(Number(of)), y(Number(value || low))];
      if (!names.has(series) || !(px >= left - 1 && px <= right + 1 && py >= top - 1 && py <= bottom + 1)) return [];
      const range = low === "" ? "" : `, interval ${digits(low)} to ${digits(high)}`;
      const [known_value, known_error] = error === "" ? [digits(value), ""] : with_error(value, error);
      const bar = known_error === "" ? "" : ` \u00b1 ${known_error}`;
      const known = value === "" ? "" : `; ${named(head[2])}: ${known_value}${bar}`;
      return [{ px, py, series, text: `${panel}${series}: ${named(head[1])} = ${digits(of)}${known}${range}` }];
    });
  });
}

for (const svg of all("figure svg:has([data-axes])")) {
  const [id, reading] = [svg.getAttribute("aria-labelledby").split("-title")[0], make("output", { className: "reading" })];
  const ring = document.createElementNS(svg.namespaceURI, "circle");
  ring.setAttribute("class", "point");
  ring.setAttribute("r", 110);
  let [points, now] = [undefined, undefined];
  const ready = async () => {
    await (POINTS_READY ??= load("points.js"));
    points ??= points_of(svg, POINTS[id] ?? []);
  };
  const show = (point) => {
    now = point;
    reading.value = point?.text ?? "";
    if (!point) return ring.remove();
    ring.setAttribute("cx", point.px);
    ring.setAttribute("cy", point.py);
    svg.append(ring);
  };
  const nearest = (x, y, among = points, weight = 1) => {
    const far = (point) => Math.hypot(point.px - x, weight * (point.py - y));
    return among.reduce((best, point) => (best && far(best) <= far(point) ? best : point), undefined);
  };
  const point_at = async ({ clientX, clientY }, near) => {
    await ready();
    const { x, y } = new DOMPoint(clientX, clientY).matrixTransform(svg.getScreenCTM().inverse());
    const point = nearest(x, y);
    show(point && Math.hypot(point.px - x, point.py - y) < near ? point : undefined);
  };
  svg.addEventListener("pointermove", (event) => point_at(event, NEAR));
  // A finger that leaves comes before its click, which stays until something else is touched.
  svg.addEventListener("click", (event) => point_at(event, Infinity));
  svg.addEventListener("pointerleave", () => show(undefined));
  svg.tabIndex = 0;
  svg.addEventListener("focus", async () => {
    await ready();
    if (svg.matches(":focus-visible")) show(points[0]);
  });
  svg.addEventListener("blur", () => show(undefined));
  svg.addEventListener("keydown", (event) => {
    const steps = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] };
    if (!now || !steps[event.key]) return;
    event.preventDefault();
    const [dx, dy] = steps[event.key];
    const series = [...new Set(points.map((point) => point.series))];
    const other = series[(series.indexOf(now.series) + dy + series.length) % series.length];
    show(dy === 0 ? (points[points.indexOf(now) + dx] ?? now) : nearest(now.px, now.py, points.filter((point) => point.series === other)));
  });
  svg.parentElement.after(reading);
}

