"""People at the keyboard, who teach in a study or play the robot.

What they see and type is here; as tutors they are `person_as_tutor`, as robots
`person_as_robot`.
"""
