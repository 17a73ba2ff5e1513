// What is done once all is in place.

// The first page says what a dotted number does.
const finding = document.querySelector(".front main > p:first-child + ul");
finding?.after(make("p", { className: "hint" }, "A dotted number opens: what it means, its error, and the command that repeats it."));
mark();
asked();
