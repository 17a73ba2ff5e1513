// The card of a number.
const card = document.getElementById("card");
let cards;
const open = async (value) => {
  await (cards ??= load("cards.js"));
  const [rows, all] = CARDS;
  const [title, lead, numbers] = all[value.dataset.card];
  card.querySelector("header span").innerHTML = title;
  card.querySelector("p").innerHTML = lead;
  card.querySelector("dl").innerHTML = numbers.map((number) => rows[number]).join("");
  if (is_copy) unlink(card);
  card.hidePopover();
  card.showPopover({ source: value });
  card.scrollTop = 0;
  // On a phone the card is at the end of the window, and its number goes above it.
  const over = value.getBoundingClientRect().bottom + 8 - card.getBoundingClientRect().top;
  if (over > 0 && phone.matches) scrollBy(0, over);
};
const values = all("[data-card]");
for (const sign of all("a[data-card]")) {
  sign.addEventListener("click", (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    open(sign);
  });
}
// Without a script a number is no button.
for (const value of all(".value")) {
  value.setAttribute("role", "button");
  value.tabIndex = 0;
  value.addEventListener("click", () => open(value));
  value.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    open(value);
  });
}
// A number in a PDF leads to its card: report.html#value:ID.
const asked = () => {
  const [kind, id] = decodeURIComponent(location.hash).split(/:(.*)/s);
  const value = kind === "#value" && values.find((value) => value.dataset.card === id);
  if (!value) return;
  value.scrollIntoView({ block: "center" });
  open(value);
};
addEventListener("hashchange", asked);

