//! The formats that points are written in.

use std::fmt::Display;
use std::io::{self, Write};

use clap::ValueEnum;

use crate::formats::npy_writer::Stored;
use crate::formats::{csv, node, npy_writer, xyz};

/// Formats that `incircle generate` writes points in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SetFormat {
    /// Rows `x,y`
    Csv,
    /// Rows `x y`
    Xyz,
    /// Shewchuk's Triangle, .node
    Node,
    /// An array of NumPy with n rows and two columns, .npy
    Npy,
}

impl SetFormat {
    /// The format of files with this extension.
    pub fn of_extension(extension: &str) -> Option<Self> {
        Some(match extension.to_ascii_lowercase().as_str() {
            "csv" | "tsv" => Self::Csv,
            "xyz" => Self::Xyz,
            "node" => Self::Node,
            "npy" => Self::Npy,
            _ => return None,
        })
    }

    /// Writes points in this format.
    pub fn write_points<N: Display + Stored>(
        self,
        points: impl ExactSizeIterator<Item = [N; 2]>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        match self {
            Self::Csv => csv::write_points(points, out),
            Self::Xyz => xyz::write_points(points, out),
            Self::Node => node::write_points(points, out),
            Self::Npy => npy_writer::write_points(points, out),
        }
    }
}
