//! Reads the number that a paper printed, and the place of its last digit.

/// The largest exponent and number of decimals of a printed number.
pub(super) const MAX_PLACES: i32 = 400;

/// Writes a number with this many decimals, none if it is negative.
pub(super) fn written(value: f64, decimals: i32) -> String {
    format!("{value:.*}", decimals.clamp(0, MAX_PLACES) as usize)
}

/// Replaces the first digit that is not zero, or else the last zero.
pub(super) fn with_other_digit(number: &str) -> String {
    let index = number.find(|c: char| ('1'..='9').contains(&c)).or_else(|| number.rfind('0'));
    let Some(index) = index else { return number.into() };
    let digit = match number.as_bytes()[index] {
        b'9' => '8',
        digit => (digit + 1).into(),
    };
    format!("{}{digit}{}", &number[..index], &number[index + 1..])
}

const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";

/// Reads a number alone, such as 0.12, 1.2e5, 3·10⁻⁴, 12 % or 0.5 ‰. Returns it and the place of
/// its last digit: its decimals when written without a power of ten, −3 if in thousands.
pub(super) fn number_alone(printed: &str) -> Option<(f64, i32)> {
    let printed = printed.replace('−', "-");
    let (printed, shift) = match (printed.strip_suffix('%'), printed.strip_suffix('‰')) {
        (Some(number), _) => (number.trim_end(), 2),
        (_, Some(number)) => (number.trim_end(), 3),
        _ => (&printed[..], 0),
    };
    let (mantissa, exponent) = match printed.find(|c| RAISED.contains(c)) {
        Some(index) => (before_power(&printed[..index])?, lowered(&printed[index..])?),
        None => {
            let (mantissa, exponent) = printed.split_once(['e', 'E']).unwrap_or((printed, "0"));
            (mantissa, exponent.to_string())
        }
    };
    let exponent = exponent.parse::<i16>().ok()? as i32 - shift;
    let digits = mantissa.strip_prefix(['-', '+']).unwrap_or(mantissa);
    let (whole, after) = digits.split_once('.').unwrap_or((digits, ""));
    let is_number = |printed: &str| printed.bytes().all(|byte| byte.is_ascii_digit());
    if whole.is_empty() || !is_number(whole) || !is_number(after) {
        return None;
    }
    let value: f64 = format!("{mantissa}e{exponent}").parse().ok()?;
    let decimals = after.len() as i32 - exponent;
    let is_read = value.is_finite() && exponent.abs().max(decimals.abs()) <= MAX_PLACES;
    is_read.then_some((value, decimals))
}

/// Returns the factor before a power: 3 of `3·10`, and 1 of `10`.
fn before_power(text: &str) -> Option<&str> {
    match text.strip_suffix("10")?.trim_end() {
        "" => Some("1"),
        factor => Some(factor.strip_suffix(['·', '×'])?.trim_end()),
    }
}

/// Writes raised digits as others: -4 for ⁻⁴.
fn lowered(text: &str) -> Option<String> {
    let place = |c| RAISED.chars().position(|raised| raised == c);
    text.chars().map(|c| "0123456789-".chars().nth(place(c)?)).collect()
}
