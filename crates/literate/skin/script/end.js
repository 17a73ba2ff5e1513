// What is done once all is in place.

// The first page says what a dotted number does.
const score = document.querySelector(".front main > p:first-child + ul ~ figure");
score?.after(make("p", { className: "hint" }, "A dotted number opens what it means and how it was found; brackets hold the standard error of its last digits."));
mark();
asked();
