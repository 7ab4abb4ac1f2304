//! Experiments, records and reports.

pub(crate) mod experiments;
pub(crate) mod report;
pub(crate) mod report_answers;
pub(crate) mod report_record;
pub(crate) mod shards;
