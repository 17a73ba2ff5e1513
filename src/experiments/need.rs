//! What a figure, a value or a claim declares that it needs.

/// A result that a figure, a value or a claim needs. The theory need not be declared: it costs
/// hundredths of a second and is computed when first looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Need {
    /// [`super::Results::sweep`].
    Sweep,
    /// [`super::Results::second_seed`].
    SecondSeed,
    /// [`super::Results::protocol`].
    Protocol,
    /// [`super::Results::protocols`].
    Protocols,
    /// [`super::Results::starts`].
    Starts,
    /// [`super::Results::laws`]; runs the main sweep too.
    Laws,
    /// [`super::Results::horizon`].
    Horizon,
    /// [`super::Results::two_masses`].
    TwoMasses,
    /// [`super::Results::segments`].
    Segments,
    /// [`super::Results::spacetime`].
    SpaceTime,
    /// [`super::Results::race`].
    Race,
    /// [`super::Results::biases`].
    Biases,
    /// [`super::Results::trials`].
    Trials,
    /// [`super::Results::scale`].
    Scale,
    /// [`super::Results::analytic`].
    Analytic,
    /// [`super::Results::measured`]: read, not run.
    Measured,
    /// [`super::Results::heat`].
    Heat,
    /// [`super::Results::nucleation`].
    Nucleation,
    /// [`super::Results::seeds`].
    Seeds,
    /// [`super::Results::history`].
    History,
    /// [`super::Results::independence`].
    Independence,
    /// [`super::Results::orbits`].
    Orbits,
    /// [`super::Results::restitution`].
    Restitution,
    /// [`super::Results::chains`].
    Chains,
    /// [`super::Results::long_protocol`].
    LongProtocol,
    /// [`super::Results::sizes`].
    Sizes,
}

impl Need {
    /// Everything: what the report needs.
    pub const ALL: [Need; 26] = [
        Need::Sweep,
        Need::SecondSeed,
        Need::Protocol,
        Need::Protocols,
        Need::Starts,
        Need::Laws,
        Need::Horizon,
        Need::TwoMasses,
        Need::Segments,
        Need::SpaceTime,
        Need::Race,
        Need::Biases,
        Need::Trials,
        Need::Scale,
        Need::Analytic,
        Need::Measured,
        Need::Heat,
        Need::Nucleation,
        Need::Seeds,
        Need::History,
        Need::Independence,
        Need::Orbits,
        Need::Restitution,
        Need::Chains,
        Need::LongProtocol,
        Need::Sizes,
    ];

    /// The name of the experiment, as values carry it.
    pub fn name(self) -> &'static str {
        match self {
            Need::Sweep => "sweep",
            Need::SecondSeed => "second_seed",
            Need::Protocol => "protocol",
            Need::Protocols => "protocols",
            Need::Starts => "starts",
            Need::Laws => "laws",
            Need::Horizon => "horizon",
            Need::TwoMasses => "two_masses",
            Need::Segments => "segments",
            Need::Race => "race",
            Need::Biases => "bias",
            Need::Trials => "trials",
            Need::Scale => "scale",
            Need::Analytic => "analytic",
            Need::Measured => "measured",
            Need::SpaceTime => "space-time",
            Need::Heat => "heat",
            Need::Nucleation => "nucleation",
            Need::Seeds => "seeds",
            Need::History => "history",
            Need::Independence => "independence",
            Need::Orbits => "orbits",
            Need::Restitution => "restitution",
            Need::Chains => "chains",
            Need::LongProtocol => "long_protocol",
            Need::Sizes => "sizes",
        }
    }
}
