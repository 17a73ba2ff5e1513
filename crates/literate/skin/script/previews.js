// A preview of an equation, a figure, a table or a reference while a link to it is pointed at.
const preview = document.getElementById("look");
let waiting;
const soon = (what) => {
  clearTimeout(waiting);
  waiting = setTimeout(what, 300);
};
const hide = () => preview.hidePopover();
// A copy has no places, buttons or links of its own.
const bare = (copy) => {
  all("[id]", copy).forEach((node) => node.removeAttribute("id"));
  all("[role=button], a", copy).forEach((node) => node.replaceWith(...node.childNodes));
  all("[tabindex]", copy).forEach((node) => node.removeAttribute("tabindex"));
  return copy;
};
const show = (link, target) => {
  preview.replaceChildren(bare(target.cloneNode(true)));
  preview.firstChild.removeAttribute("id");
  preview.showPopover({ source: link });
  // A long equation is as small as it must be.
  const box = preview.querySelector(".equation .scroll");
  if (box && box.scrollWidth > box.clientWidth) box.style.fontSize = `${(0.97 * box.clientWidth) / box.scrollWidth}em`;
};
for (const link of all('main a[href^="#"]')) {
  const target = document.getElementById(decodeURIComponent(link.hash.slice(1)));
  if (!target?.matches(".equation, figure, .references li") || target.contains(link)) continue;
  link.addEventListener("pointerenter", () => soon(() => show(link, target)));
  link.addEventListener("pointerleave", () => soon(hide));
  link.addEventListener("focus", () => link.matches(":focus-visible") && soon(() => show(link, target)));
  link.addEventListener("blur", () => soon(hide));
}
preview.addEventListener("pointerenter", () => clearTimeout(waiting));
preview.addEventListener("pointerleave", () => soon(hide));
addEventListener("keydown", ({ key }) => key === "Escape" && hide());

