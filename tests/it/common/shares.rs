//! Tests that look at many meshes or scenes, in shares, so that none is a long tail on a few cores.
//!
//! `in_shares!(name, 4)` makes tests `name::share_1_of_4` to `name::share_4_of_4` of a function `name` that takes its [`Share`].

/// Every so manyth of a list, from the first that is this share's.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Share {
    /// From 0.
    pub(crate) index: usize,
    /// How many shares there are.
    pub(crate) of: usize,
}

impl Share {
    /// This share of a list.
    pub(crate) fn part<T>(self, all: impl IntoIterator<Item = T>) -> impl Iterator<Item = T> {
        all.into_iter().skip(self.index).step_by(self.of)
    }

    /// This share's part of a count of all, where the same is met again and again.
    pub(crate) fn exactly(self, of_all: usize) -> usize {
        of_all / self.of
    }

    /// What a share has at least where all have so many: shares are not alike.
    pub(crate) fn least(self, of_all: usize) -> usize {
        of_all / (2 * self.of)
    }
}

/// A test for each share of what a function looks at.
macro_rules! in_shares {
    ($name:ident, 2) => {
        in_shares!($name, 2: share_1_of_2 0, share_2_of_2 1);
    };
    ($name:ident, 4) => {
        in_shares!($name, 4: share_1_of_4 0, share_2_of_4 1, share_3_of_4 2, share_4_of_4 3);
    };
    ($name:ident, 8) => {
        in_shares!(
            $name, 8: share_1_of_8 0, share_2_of_8 1, share_3_of_8 2, share_4_of_8 3,
            share_5_of_8 4, share_6_of_8 5, share_7_of_8 6, share_8_of_8 7
        );
    };
    ($name:ident, 16) => {
        in_shares!(
            $name, 16: share_1_of_16 0, share_2_of_16 1, share_3_of_16 2, share_4_of_16 3,
            share_5_of_16 4, share_6_of_16 5, share_7_of_16 6, share_8_of_16 7,
            share_9_of_16 8, share_10_of_16 9, share_11_of_16 10, share_12_of_16 11,
            share_13_of_16 12, share_14_of_16 13, share_15_of_16 14, share_16_of_16 15
        );
    };
    ($name:ident, $of:literal: $($share:ident $index:literal),*) => {
        mod $name {
            $(#[test]
            fn $share() {
                super::$name($crate::common::shares::Share { index: $index, of: $of });
            })*
        }
    };
}

pub(crate) use in_shares;

#[test]
fn shares_are_the_whole() {
    let shares = (0..4).map(|index| Share { index, of: 4 });
    let mut all: Vec<u32> = shares.flat_map(|share| share.part(0..30)).collect();
    all.sort_unstable();
    assert_eq!(all, Vec::from_iter(0..30));
}
