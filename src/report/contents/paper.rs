//! What the paper printed: the groups `paper` and `printed`.

use crate::claims::Published;
use crate::report::values::Value;

pub fn values(published: &Published) -> Vec<Value> {
    let chosen = published.parameters.iter().map(|p| {
        let id = format!("paper.{}", p.id);
        Value::printed(id, &format!("{}", p.value), &p.place).data_only()
    });
    let stated = published.statements.iter().filter_map(|s| {
        let text = format!("{:.*}", usize::from(s.decimals), s.value?);
        Some(Value::printed(format!("printed.{}", s.id), &text, &s.place).data_only())
    });
    let digest = Value::text("published_digest", &published.digest[..16]);
    chosen.chain(stated).chain([digest]).collect()
}
