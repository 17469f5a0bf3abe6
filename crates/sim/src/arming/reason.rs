use std::borrow::Cow;

/// A reason not to arm, as the vehicle words it.
pub(crate) type Reason = Cow<'static, str>;
