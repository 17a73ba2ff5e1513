//! Decimal numbers of the command line.

use clap::builder::ValueParser;
use clap::{Arg, Command, value_parser};

/// Reads a number as the nearest double. Infinity and NaN pass where they are written so: who takes the number tells
/// its range.
///
/// # Errors
/// One line for what is no number, and for what is no zero and finite but would be read as 0 or as infinity.
pub fn parse(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let read = text.parse::<f64>();
    let x = read.map_err(|_| "it is no number; write a decimal such as 0.12".to_string())?;
    let digits = text.split(['e', 'E']).next().unwrap_or_default();
    if x == 0.0 && digits.contains(|c| matches!(c, '1'..='9')) {
        return Err("it is so small that it would be read as 0; write 0 if that is meant".into());
    }
    if x.is_infinite() && digits.contains(|c: char| c.is_ascii_digit()) {
        return Err("it is so large that it would be read as infinity; give a smaller one".into());
    }
    // A negative zero would be printed as one.
    Ok(x + 0.0)
}

/// The command with this reader for each of its options that takes a number.
pub fn of_all(command: Command) -> Command {
    let plain = ValueParser::from(value_parser!(f64)).type_id();
    let read = |arg: Arg| match arg.get_value_parser().type_id() == plain {
        true => arg.value_parser(parse),
        false => arg,
    };
    command.mut_args(read).mut_subcommands(of_all)
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn what_no_double_is_near_is_refused() {
        for (text, x) in
            [("0e-999", 0.0), ("1e-320", 1e-320), (" -.5 ", -0.5), ("-inf", f64::NEG_INFINITY)]
        {
            assert_eq!(parse(text), Ok(x));
        }
        assert!(parse("NaN").unwrap().is_nan() && parse("-0").unwrap().is_sign_positive());
        for (text, what) in
            [("1e-400", "as 0"), ("-0.1e-999", "as 0"), ("0.1E999", "infinity"), ("", "no number")]
        {
            assert!(parse(text).unwrap_err().contains(what), "{text}");
        }
    }
}
