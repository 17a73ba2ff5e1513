// On a phone a figure can be seen larger; its box scrolls then.
for (const box of phone.matches ? all("figure:not(.table, .lab) > .scroll:has(svg)") : []) {
  const turn = make("button", { type: "button", className: "enlarge" }, "Enlarge");
  turn.addEventListener("click", () => {
    turn.textContent = box.classList.toggle("large") ? "Fit to the screen" : "Enlarge";
    stop_at_boxes();
  });
  box.closest("figure").querySelector("figcaption").prepend(turn);
}

