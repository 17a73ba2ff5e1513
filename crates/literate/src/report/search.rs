//! The index of the search: search.js has the words of all pages.

/// What a search reads of a page: place and name of the section, and text, for each paragraph, figure and item.
pub fn texts(body: &str, name: &str) -> Vec<[String; 3]> {
    let mut section = ["text".to_string(), name.to_string()];
    let ends = ["</p>", "</figure>", "</li>", "</h2>", "</h3>"];
    let pieces = ends.iter().fold(vec![body], |pieces, end| {
        pieces.into_iter().flat_map(|piece| piece.split(end)).collect()
    });
    let mut out = Vec::new();
    for piece in pieces {
        let text = words(piece);
        let heading = piece.split_once("<h2 id=\"").or_else(|| piece.split_once("<h3 id=\""));
        if let Some((id, _)) = heading.and_then(|(_, heading)| heading.split_once('"')) {
            section = [id.to_string(), text.clone()];
        }
        if !text.is_empty() {
            let [id, name] = section.clone();
            out.push([id, name, text]);
        }
    }
    out
}

/// The words of a piece of a page; pictures have none.
fn words(html: &str) -> String {
    let pieces = html.split("<svg").enumerate().map(|(i, piece)| match i {
        0 => piece,
        _ => piece.split_once("</svg>").map_or("", |(_, rest)| rest),
    });
    let text: String = pieces
        .flat_map(|piece| piece.split('<'))
        .map(|piece| piece.split_once('>').map_or(piece, |(_, text)| text))
        .collect();
    let text = text
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&amp;", "&");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
