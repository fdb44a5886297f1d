//! The HTML document: markup, style and program, which are the same for all piles, and the data of one pile.

use base64::Engine;
use base64::engine::general_purpose::STANDARD as BASE64;
use cannonpile_dem::template::fill;
use hmac_sha256::Hash;
use serde_json::Value;

/// The program. Each part uses the parts before it.
const PROGRAM: [&str; 7] = [
    include_str!("program/numbers.js"),
    include_str!("program/pile.js"),
    include_str!("program/camera.js"),
    include_str!("program/drawing.js"),
    include_str!("program/table.js"),
    include_str!("program/view.js"),
    include_str!("program/page.js"),
];

/// Returns the text of the file.
pub(super) fn text(data: &Value) -> String {
    let style = include_str!("page.css");
    let program = format!("\"use strict\";\n{}", PROGRAM.concat());
    let texts = [
        ("program_hash", hash(&program)),
        ("style_hash", hash(style)),
        ("style", style.to_owned()),
        (
            "sphere_vert",
            include_str!("shaders/sphere.vert").to_owned(),
        ),
        (
            "sphere_frag",
            include_str!("shaders/sphere.frag").to_owned(),
        ),
        (
            "contact_vert",
            include_str!("shaders/contact.vert").to_owned(),
        ),
        (
            "contact_frag",
            include_str!("shaders/contact.frag").to_owned(),
        ),
        ("program", program),
        // The data come last, so that braces in them are not replaced.
        ("data", escaped(data)),
    ];
    fill(include_str!("page.html"), &texts)
}

/// Returns the hash that allows a script or a style in the content security policy.
fn hash(text: &str) -> String {
    format!("'sha256-{}'", BASE64.encode(Hash::hash(text.as_bytes())))
}

/// Returns JSON that an HTML parser cannot read as the end of a script or as a comment.
fn escaped(data: &Value) -> String {
    let json = data.to_string().replace('<', "\\u003c");
    json.replace('\u{2028}', "\\u2028")
        .replace('\u{2029}', "\\u2029")
}
