//! A device of version 1.2 of the protocol, which knows no engines, no tags and no number of jobs: the host must send
//! it what that version has and nothing else.

use std::time::Instant;

use crate::common::batches::{alone, batch};
use crate::common::Random;
use incircle::transports::{receive_in_pieces, AnswerHead, Capabilities};
use incircle::{Device, Options, Transport, TransportError};
use incircle_model::CommandModel;
use incircle_protocol::{answer_opcode, Command, Opcode};

/// The model for 512 points with five contexts, as version 1.2 has it.
struct Older {
    model: CommandModel,
    answers: Vec<u32>,
    takes_ahead: bool,
}

impl Older {
    fn device(takes_ahead: bool) -> Device {
        let model = CommandModel::new(16, 512, 32).expect("possible").with_contexts(5);
        Device::from_transport(Box::new(Self { model, answers: Vec::new(), takes_ahead }))
    }
}

impl Transport for Older {
    fn name(&self) -> String {
        "older".to_owned()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], _: Instant) -> Result<(), TransportError> {
        for command in commands {
            let mut words = Vec::new();
            command.encode(&mut words);
            // Of a command word, version 1.2 has the opcode, and in `Clear` the contexts and the bit of a batch.
            assert_eq!(words[0] & 0x00ff_fe00, 0, "{:08x}", words[0]);
            assert!(words[0] & 0x1ff == 0 || command.opcode() == Opcode::Clear, "{:08x}", words[0]);
            self.model.send(&words);
            let mut answer = vec![0; 2];
            assert_eq!(self.model.receive(&mut answer), 2);
            answer.resize(2 + answer[1] as usize, 0);
            assert_eq!(self.model.receive(&mut answer[2..]), answer.len() - 2);
            assert_eq!(answer[0] & 0xffff, 0, "the low half of a header is zero in version 1.2");
            if answer_opcode(answer[0]) == Opcode::Hello as u8 {
                answer[3] = 1 << 16 | 2;
                answer[7] &= 0xff;
                // Such a device knows no short ids.
                answer[8] &= 0xffff;
            }
            self.answers.extend(answer);
        }
        Ok(())
    }

    fn receive(&mut self, head: AnswerHead, payload: &mut [u32], _: Instant) -> Result<AnswerHead, TransportError> {
        receive_in_pieces(head, payload, |words| {
            assert!(words.len() <= self.answers.len(), "more words than the device has sent");
            words.copy_from_slice(&self.answers[..words.len()]);
            self.answers.drain(..words.len());
            Ok(())
        })
    }

    fn capabilities(&self) -> Capabilities {
        Capabilities { takes_ahead: self.takes_ahead, ..Capabilities::default() }
    }
}

#[test]
fn a_device_of_version_1_2_is_served() {
    let mut random = Random(12);
    // Small jobs go side by side, the others one by one.
    let jobs: Vec<_> = (0..40).map(|job| random.points(if job % 4 == 0 { 400 } else { 60 }, 1 << 16)).collect();
    let right = alone(&jobs);
    for takes_ahead in [false, true] {
        let mut device = Older::device(takes_ahead);
        assert!(batch(&mut device, &jobs, &Options::default()).expect("meshes") == right);
        let mut session = device.session().expect("a session");
        let identity = session.identity();
        assert_eq!((identity.protocol_version, identity.engines, identity.contexts), (1 << 16 | 2, 1, 5));
        for (points, right) in jobs.iter().zip(&right) {
            assert!(session.triangulate_with(points, &Options::default().contexts(3)).expect("a mesh").mesh == *right);
        }
    }
}
