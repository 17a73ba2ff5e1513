// Pictures: a frame with its axes, and what is drawn in units of the data.

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** A canvas as sharp as the screen, empty, with its words for those who do not see it. */
function sheet(canvas, height, told) {
  const [ratio, width] = [devicePixelRatio, canvas.clientWidth];
  canvas.style.height = `${height}px`;
  [canvas.width, canvas.height] = [width * ratio, height * ratio];
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", told);
  const c = canvas.getContext("2d");
  c.scale(ratio, ratio);
  return { c, width };
}

/** Writes words, those between stars in italics; the share of them that lies left of x is 0, 1/2 or 1. */
function write(c, text, x, y, share = 0.5, name = "ink") {
  const family = getComputedStyle(document.body).fontFamily;
  const pieces = text.split("*").map((piece, i) => [piece, `${i % 2 ? "italic " : ""}15px ${family}`]);
  const wide = pieces.map(([piece, font]) => ((c.font = font), c.measureText(piece).width));
  c.fillStyle = colour(name);
  c.textAlign = "left";
  let at = x - share * wide.reduce((a, b) => a + b, 0);
  pieces.forEach(([piece, font], i) => ((c.font = font), c.fillText(piece, at, y), (at += wide[i])));
}

/** The numbered places of an axis. */
function ticks(from, to) {
  const ten = 10 ** Math.floor(Math.log10((to - from) / 3));
  const by = ten * [5, 2, 1].find((own) => own * ten * 2 <= to - from);
  const first = Math.ceil(from / by - 1e-9);
  const all = Array.from({ length: Math.floor(to / by + 1e-9) - first + 1 }, (_, i) => Number(((first + i) * by).toPrecision(6)));
  const digits = Math.max(0, -Math.floor(Math.log10(by) + 1e-9));
  const between = Array.from({ length: all.length + 1 }, (_, i) => (all[0] ?? from) + (i - 0.5) * by).filter((x) => x >= from && x <= to);
  return { all, between, said: (x) => x.toFixed(digits).replace("-", "−") };
}

function plot(canvas, height, [left, right, below], [low, high, beside], told) {
  const { c, width } = sheet(canvas, height, told);
  const box = { x: 54, y: 24, width: width - 68, height: height - 68 };
  const px = (x) => box.x + (box.width * (x - left)) / (right - left);
  const py = (y) => box.y + box.height * (1 - (y - low) / (high - low));
  const floor = box.y + box.height;
  const [across, up] = [ticks(left, right), ticks(low, high)];
  c.strokeStyle = colour("ink");
  c.lineWidth = 1.2;
  c.beginPath();
  [[box.x, box.y], [box.x, floor], [box.x + box.width, floor]].forEach(([x, y]) => c.lineTo(x, y));
  for (const x of across.all) (c.moveTo(px(x), floor), c.lineTo(px(x), floor + 6), write(c, across.said(x), px(x), floor + 21));
  for (const y of up.all) (c.moveTo(box.x, py(y)), c.lineTo(box.x - 6, py(y)), write(c, up.said(y), box.x - 10, py(y) + 5, 1));
  for (const x of across.between) (c.moveTo(px(x), floor), c.lineTo(px(x), floor + 3));
  for (const y of up.between) (c.moveTo(box.x, py(y)), c.lineTo(box.x - 3, py(y)));
  c.stroke();
  write(c, below, box.x + box.width / 2, height - 5);
  c.save();
  c.translate(13, box.y + box.height / 2);
  c.rotate(-Math.PI / 2);
  write(c, beside, 0, 0);
  c.restore();

  let alpha = 1;
  const path = (points) => {
    c.beginPath();
    points.forEach(([x, y]) => c.lineTo(px(x), py(y)));
  };
  const drawn = {
    words: (text, x, y, name, share = 0.5) => write(c, text, px(x), py(y) - 5, share, name),
    image(source) {
      c.imageSmoothingEnabled = source.height > box.height;
      c.drawImage(source, box.x, box.y, box.width, box.height);
    },
    band(points, name, strength = 0.75) {
      [c.fillStyle, c.globalAlpha] = [colour(name), alpha * strength];
      path([...points.map(([x, , high]) => [x, high]), ...points.toReversed()]);
      c.fill();
    },
    line(points, name, dash = [], wide = 2) {
      [c.strokeStyle, c.lineWidth] = [colour(name), wide];
      c.setLineDash(dash);
      path(points);
      c.stroke();
    },
    columns(heights, name) {
      [c.strokeStyle, c.lineWidth] = [colour(name), Math.max(1, (0.6 * box.width) / (right - left))];
      c.beginPath();
      heights.forEach((y, i) => (c.moveTo(px(i + 1), py(0)), c.lineTo(px(i + 1), py(y))));
      c.stroke();
    },
    marks(points, name, radius) {
      c.fillStyle = colour(name);
      points.forEach(([x, y]) => (c.beginPath(), c.arc(px(x), py(y), radius, 0, 7), c.fill()));
    },
    // A triangle that stands on the axis and points up.
    peak(x, name) {
      c.fillStyle = colour(name);
      c.beginPath();
      [[0, -14], [7, 0], [-7, 0]].forEach(([dx, dy]) => c.lineTo(px(x) + dx, floor + dy));
      c.fill();
    },
  };
  const inside = (draw) => (...all) => {
    c.save();
    c.beginPath();
    c.rect(box.x, 0, box.width, floor);
    c.clip();
    c.globalAlpha = alpha;
    draw(...all);
    c.restore();
  };
  const all = Object.entries(drawn).map(([name, draw]) => [name, inside(draw)]);
  // `fade` makes faint what is drawn from now on; `at` says where x lies, between which heights.
  return { ...Object.fromEntries(all), fade: (share) => (alpha = share), at: (x) => [px(x), box.y, floor] };
}

/** Impacts in space and time, a dot for each gap and column of time. */
function impacts({ picture, columns, gaps }) {
  const dots = make("canvas", { width: columns, height: gaps });
  const image = new ImageData(columns, gaps);
  const [r, g, b] = colour("ink").match(/\w\w/g).map((pair) => parseInt(pair, 16));
  picture.forEach((count, i) => {
    const above = (gaps - 1 - Math.floor(i / columns)) * columns + (i % columns);
    if (count > 0) image.data.set([r, g, b, Math.min(255, 130 + 25 * count)], 4 * above);
  });
  dots.getContext("2d").putImageData(image, 0, 0);
  return dots;
}
