//! Modal data as numpy.savez writes them.

use holonom::body::flexible::modal::{Array, ModalData};
use std::fs::File;
use std::io::Write;
use std::path::Path;

pub fn write(path: &Path, data: &ModalData<Array>) {
    let mut archive = zip::ZipWriter::new(File::create(path).unwrap());
    let options = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    let mut put = |name: &str, file: Vec<u8>| {
        archive.start_file(format!("{name}.npy"), options).unwrap();
        archive.write_all(&file).unwrap();
    };
    let numbers = |array: &Array| {
        let data: Vec<u8> = array.values.iter().flat_map(|value| value.to_le_bytes()).collect();
        npy("<f8", &array.shape, &data)
    };
    let lumped = data.lumped.as_ref().unwrap();
    let nodes = &data.nodes.as_ref().unwrap().0;
    put("modal_stiffness", numbers(data.modal_stiffness.as_ref().unwrap()));
    put("modal_damping", numbers(data.modal_damping.as_ref().unwrap()));
    put("lumped_masses", numbers(&stacked(lumped.iter().map(|one| &one.mass))));
    put("lumped_positions", numbers(&stacked(lumped.iter().map(|one| &one.position))));
    put("lumped_translations", numbers(&stacked(lumped.iter().map(|one| &one.translation))));
    put("node_positions", numbers(&stacked(nodes.iter().map(|(_, node)| &node.position))));
    put("node_translations", numbers(&stacked(nodes.iter().map(|(_, node)| &node.translation))));
    put("node_rotations", numbers(&stacked(nodes.iter().filter_map(|(_, node)| node.rotation.as_ref()))));
    archive.finish().unwrap();
}

/// One array of what all have.
fn stacked<'a>(parts: impl Iterator<Item = &'a Array>) -> Array {
    let parts: Vec<&Array> = parts.collect();
    let shape = std::iter::once(parts.len()).chain(parts[0].shape.iter().copied()).collect();
    Array { shape, values: parts.iter().flat_map(|part| part.values.iter().copied()).collect() }
}

fn npy(descr: &str, shape: &[usize], data: &[u8]) -> Vec<u8> {
    let lengths: String = shape.iter().map(|length| format!("{length},")).collect();
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({lengths}), }}\n");
    let length = u16::try_from(header.len()).unwrap().to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), data].concat()
}
