// What readers can run. On the first page it starts by itself, in place of the figure before it,
// which the style sheet hides from the beginning; elsewhere when it is asked to, or when the
// address has settings for it: beyond.html#chain:sigma=0.1.

let lab;
if (all(".lab").length === 0) document.documentElement.classList.remove("runs");
for (const figure of all(".runs .lab")) {
  const status = figure.querySelector("[role=status]");
  const is_asked = location.hash.startsWith(`#${figure.dataset.lab}:`);
  const run = async (asked) => {
    await (lab ??= load("lab.js"));
    await open_lab(figure, asked);
    if (is_asked) figure.scrollIntoView();
  };
  figure.hidden = false;
  const begin = () => {
    status.textContent = "Loading …";
    run(true).catch(() => {
      lab = undefined;
      status.textContent = "lab.js cannot be loaded; it belongs beside this page.";
    });
  };
  figure.querySelector("button").addEventListener("click", begin);
  if (document.body.className === "front") run(false).catch(() => {
    lab = undefined;
    document.documentElement.classList.remove("runs");
  });
  else if (is_asked) begin();
  if (is_asked) figure.scrollIntoView();
}

