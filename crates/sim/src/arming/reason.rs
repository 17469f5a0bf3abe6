use std::borrow::Cow;

/// A reason against arming, as the vehicle words it.
pub(crate) type Reason = Cow<'static, str>;
