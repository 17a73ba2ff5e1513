// Numbers and verdicts of a table, or of the list at the top of the first page, are one stop of the
// Tab key; arrows go from one to the next.

for (const group of all("table, .front main > p:first-child + ul")) {
  const stops = all(".value, a.verdict[data-card]", group);
  stops.slice(1).forEach((stop) => (stop.tabIndex = -1));
  const column = (stop) => stop.closest("td, th")?.cellIndex;
  const steps = {
    ArrowRight: (at) => stops[at + 1],
    ArrowLeft: (at) => stops[at - 1],
    ArrowDown: (at) => stops.find((stop, i) => i > at && column(stop) === column(stops[at])),
    ArrowUp: (at) => stops.findLast((stop, i) => i < at && column(stop) === column(stops[at])),
  };
  group.addEventListener("keydown", (event) => {
    const at = stops.indexOf(document.activeElement);
    const next = at < 0 ? undefined : steps[event.key]?.(at);
    if (!next) return;
    event.preventDefault();
    stops.forEach((stop) => (stop.tabIndex = stop === next ? 0 : -1));
    next.focus();
  });
}

// A box is a stop only where it scrolls.
const boxes = all(".scroll, pre");
const stop_at_boxes = () => {
  for (const [box, scrolls] of boxes.map((box) => [box, box.scrollWidth > box.clientWidth + 1])) {
    if (scrolls) box.tabIndex = 0;
    else box.removeAttribute("tabindex");
  }
};
stop_at_boxes();
addEventListener("resize", stop_at_boxes);
document.fonts.ready.then(stop_at_boxes);

