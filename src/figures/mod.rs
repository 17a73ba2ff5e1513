//! The fifteen figures of the paper, one a file; each returns an SVG string and its data.
