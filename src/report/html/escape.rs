//! Text and addresses for HTML that is XML too.

/// Text inside an element or an attribute.
pub fn text(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}

/// `fig:3` → `fig-3`, `card:printed.p_15` → `card-printed-p_15`.
pub fn id(id: &str) -> String {
    id.replace([':', '.', '[', ']', '=', ','], "-")
}
