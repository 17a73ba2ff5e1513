//! Counts the cases in which two sides of a statement were compared.

/// Whole cases: how many were compared, and how many of these failed.
pub(crate) type Cases = [u64; 2];

/// Counts the cases, and those that do not agree.
pub(crate) fn cases(agree: impl IntoIterator<Item = bool>) -> Cases {
    agree.into_iter().fold([0, 0], |[all, failed], agrees| [all + 1, failed + u64::from(!agrees)])
}
