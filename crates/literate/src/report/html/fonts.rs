//! The faces of the page, inside the page: text as in the figures, and one for mathematics.

use std::fmt::Write as _;

/// The family of mathematics.
const MATHS: &str = "Libertinus Math";

/// Family, style, weight, file.
const FACES: [(&str, &str, &str, &[u8]); 4] = [
    (
        "Libertinus Serif",
        "normal",
        "400",
        include_bytes!("../../../fonts/LibertinusSerif-Regular.woff2"),
    ),
    (
        "Libertinus Serif",
        "italic",
        "400",
        include_bytes!("../../../fonts/LibertinusSerif-Italic.woff2"),
    ),
    (
        "Libertinus Serif",
        "normal",
        "700",
        include_bytes!("../../../fonts/LibertinusSerif-Bold.woff2"),
    ),
    (MATHS, "normal", "400", include_bytes!("../../../fonts/LibertinusMath-Regular.woff2")),
];

/// The rules that bring the faces; the one for mathematics, the largest, only where a page has any.
pub fn rules(body: &str) -> String {
    let mut out = String::new();
    let has_maths = body.contains("<math");
    for (family, style, weight, bytes) in FACES {
        if family == MATHS && !has_maths {
            continue;
        }
        let _ = writeln!(
            out,
            "@font-face {{ font-family: \"{family}\"; font-style: {style}; font-weight: {weight}; \
             src: url(data:font/woff2;base64,{}) format(\"woff2\"); }}",
            base64(bytes)
        );
    }
    out
}

/// Base64 with padding (RFC 4648).
pub fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let at = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for i in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * i) & 63) as usize];
            out.push(if i <= chunk.len() { letter as char } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    #[test]
    fn base64_of_the_standard() {
        for (text, code) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v")] {
            assert_eq!(super::base64(text.as_bytes()), code);
        }
        assert_eq!(super::base64(b"foobar"), "Zm9vYmFy");
    }
}
