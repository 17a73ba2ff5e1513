//! Sections 3 to 9: the impact graph, the number of its circuits, their probability, the jump.
