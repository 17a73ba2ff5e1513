//! Values for the templates, and Markdown and LaTeX from them.
