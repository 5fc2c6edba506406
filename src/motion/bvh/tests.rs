//! Files as they come, and files that are none.

use super::*;
use proptest::prelude::*;

const ARM: &str = "HIERARCHY
ROOT hips
{
  OFFSET 0 1 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
  JOINT arm
  {
    OFFSET 1 2 3
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 0 4
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.01
1 2 3 4 5 6 7 8 9
1 2 3 4 5 6 7 8 10
";

#[test]
fn a_file_is_read_as_it_is_written() {
    let bvh = Bvh::parse(ARM).unwrap();
    assert_eq!(bvh.joints.len(), 2);
    assert_eq!(bvh.joints[1].parent, Some(0));
    assert_eq!(bvh.joints[1].offset, [1.0, 2.0, 3.0]);
    assert_eq!(bvh.joints[1].ends, [[0.0, 0.0, 4.0]]);
    let order = [2, 0, 1].map(Channel::Rotation);
    assert_eq!(bvh.joints[1].channels, order);
    assert_eq!(bvh.frame_time, 0.01);
    assert_eq!(bvh.frames[1][8], 10.0);
}

#[test]
fn blanks_line_ends_and_order_mean_nothing() {
    let plain = Bvh::parse(ARM).unwrap();
    let forms = [
        ARM.replace('\n', "\r\n"),
        ARM.replace("  ", "\t"),
        ARM.replace('\n', "\n\n \t\n"),
        ARM.replace("\n  {", " {").replace("\n{", "{"),
        ARM.replace(
            "    End Site\n    {\n      OFFSET 0 0 4\n    }",
            "End Site{OFFSET 0 0 4}",
        ),
        ARM.replace("Frame Time:", "Frame  Time :")
            .replace(" :", ":"),
        ARM.replace("7 8 10", "0.7e1 +8.0 1E+1"),
        ARM.replace("position", "Position")
            .replace("rotation", "Rotation"),
        format!("\u{feff}{ARM}"),
        ARM.trim_end().to_owned(),
    ];
    for form in forms {
        assert_eq!(Bvh::parse(&form).as_ref(), Ok(&plain), "{form}");
    }
}

#[test]
fn a_joint_may_have_no_channels_several_ends_and_a_name_of_two_words() {
    let text = ARM
        .replace("    CHANNELS 3 Zrotation Xrotation Yrotation\n", "")
        .replace(" 7 8 9", "")
        .replace(" 7 8 10", "")
        .replace("JOINT arm", "JOINT left arm")
        .replace(
            "    End Site",
            "    End Site\n {\n OFFSET 1 1 1\n }\n    End Site",
        );
    let bvh = Bvh::parse(&text).unwrap();
    assert_eq!(bvh.joints[1].name, "left arm");
    assert_eq!(bvh.joints[1].channels, []);
    assert_eq!(bvh.joints[1].ends.len(), 2);
    assert_eq!(bvh.frames[0].len(), 6);
}

/// What stands in the file, what in its place, and what the message must be.
#[test]
fn every_slip_is_told_with_its_line() {
    let cases = [
        (
            "HIERARCHY\n",
            "",
            "line 1: found \"ROOT hips\"; allowed: HIERARCHY",
        ),
        (
            "ROOT",
            "JOINT",
            "line 2: the hierarchy has 0 roots; allowed: 1",
        ),
        (
            "MOTION",
            "ROOT b\n{\n}\nMOTION",
            "line 16: the hierarchy has 2 roots; allowed: 1",
        ),
        (
            "  }\n}\nMOTION",
            "  }\nMOTION",
            "line 15: the brace of \"hips\", opened in line 3, is not closed",
        ),
        (
            "}\nMOTION",
            "}}\nMOTION",
            "line 15: found \"}\"; allowed: a brace that closes",
        ),
        (
            "JOINT arm",
            "JOINT hips",
            "line 6: joint \"hips\" is there twice",
        ),
        (
            "JOINT arm",
            "JOINT",
            "line 6: found \"\"; allowed: a name after",
        ),
        (
            "JOINT arm",
            "JONT arm",
            "line 6: found \"JONT arm\"; allowed: OFFSET, CHANNELS, JOINT",
        ),
        (
            "Xrotation Yrotation\n    End",
            "Xrotation Wrotation\n    End",
            "line 9: unknown channel \"Wrotation\" of joint \"arm\"; allowed: Xposition",
        ),
        (
            "Xrotation Yrotation\n    End",
            "Xrotation Xrotation\n    End",
            "line 9: unknown channel \"Xrotation\" of joint \"arm\"",
        ),
        (
            "CHANNELS 3",
            "CHANNELS 4",
            "line 9: 4 channels announced for joint \"arm\", 3 found",
        ),
        (
            "OFFSET 1 2 3",
            "OFFSET 1 2",
            "line 8: offset of \"arm\" is \"1 2\"; allowed: 3 numbers",
        ),
        (
            "OFFSET 0 0 4",
            "OFFSET 0 0 nan",
            "line 12: offset of \"End Site of arm\" is",
        ),
        (
            "Frames: 2",
            "Frames: 100001",
            "line 17: 100001 frames; allowed: 1 to 100000",
        ),
        (
            "Frames: 2",
            "Frames: 0",
            "line 17: 0 frames; allowed: 1 to 100000",
        ),
        (
            "Frames: 2",
            "Frames: -1",
            "line 17: -1 frames; allowed: a whole number, 1 to",
        ),
        (
            "Frames: 2",
            "Frames: 9999999999999999999999",
            "allowed: a whole number",
        ),
        (
            "0.01",
            "0",
            "line 18: frame time is \"0\"; allowed: 0.0001 to 60 s",
        ),
        ("0.01", "-0.01", "line 18: frame time is \"-0.01\"; allowed"),
        ("0.01", "nan", "line 18: frame time is \"nan\"; allowed"),
        ("0.01", "", "line 18: frame time is \"\"; allowed"),
        (
            "8 10",
            "nan 10",
            "line 20, value 8: Xrotation of joint \"arm\" is \"nan\"; allowed: a finite number",
        ),
        (
            "1 2 3 4 5 6 7 8 10",
            "1 2 1e999 4 5 6 7 8 10",
            "line 20, value 3: Zposition of joint \"hips\" is \"1e999\"",
        ),
        (
            "8 10",
            "8,0 10",
            "value 8: Xrotation of joint \"arm\" is \"8,0\"",
        ),
        (
            "8 10",
            "8",
            "line 20: frame 2 has 8 values; allowed: 9, one each channel",
        ),
        ("8 10", "8 10 11", "line 20: frame 2 has 10 values"),
        (
            "Frames: 2",
            "Frames: 3",
            "3 frames announced, 2 found: the file may be cut off",
        ),
        (
            "Frames: 2",
            "Frames: 1",
            "line 20: more than the 1 frames announced",
        ),
        (
            "MOTION\nFrames: 2\n",
            "MOTION\n",
            "line 17: found \"Frame Time: 0.01\"; allowed: Frames:",
        ),
    ];
    for (right, slip, says) in cases {
        let text = ARM.replacen(right, slip, 1);
        assert_ne!(text, ARM, "{right:?} is not in the file");
        let said = Bvh::parse(&text).unwrap_err().to_string();
        assert!(said.contains(says), "{slip:?}: {said}\n  instead of {says}");
    }
}

#[test]
fn every_beginning_of_a_file_is_refused_in_words() {
    // The last line may lose its line end and the last digit of its last number.
    for length in 0..ARM.len() - 2 {
        assert!(Bvh::parse(&ARM[..length]).is_err(), "{}", &ARM[..length]);
    }
    let said = |text: &str| Bvh::parse(text).unwrap_err().to_string();
    assert_eq!(said(""), "line 1: found \"nothing\"; allowed: HIERARCHY");
    assert_eq!(
        said(ARM.split("MOTION").next().unwrap()),
        "the file ends before \"MOTION\": it may be cut off"
    );
}

#[test]
fn joints_ten_thousand_deep_are_read_and_more_refused() {
    let deep = |count: usize| {
        let mut text = "HIERARCHY\n".to_owned();
        for joint in 0..count {
            let head = if joint == 0 { "ROOT" } else { "JOINT" };
            text.push_str(&format!("{head} j{joint} {{ OFFSET 0 1 0\n"));
        }
        text.push_str(&"}".repeat(count));
        text.push_str("\nMOTION\nFrames: 1\nFrame Time: 1\n");
        text
    };
    // No channels: a frame of no values is no line, so that none is found.
    let refused = Bvh::parse(&deep(10_000)).unwrap_err();
    assert_eq!(
        refused,
        BvhError::TooFewFrames {
            found: 0,
            announced: 1
        }
    );
    let refused = Bvh::parse(&deep(300_000)).unwrap_err();
    assert_eq!(refused.to_string(), "line 10002: more than 10000 joints");
}

proptest! {
    #[test]
    fn no_text_makes_the_reader_panic(text in "(HIERARCHY|ROOT a|JOINT b|\\{|\\}|OFFSET 1 2 3|CHANNELS 1 Xrotation|End Site|MOTION|Frames: 1|Frame Time: 1|1|[ -~]{0,9}|\n){0,40}") {
        let _ = Bvh::parse(&text);
    }

    #[test]
    fn no_change_of_bytes_makes_the_reader_panic(at in 0_usize..300, with in "\\PC{0,4}") {
        let mut text = ARM.to_owned();
        let at = at.min(text.len());
        text.insert_str(at, &with);
        let _ = Bvh::parse(&text);
    }
}
