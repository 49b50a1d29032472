"""People at the keyboard, who teach in a study or play the robot.

What they see and type is here; as tutors they are `kille.lab.people.tutor`, as
robots `kille.lab.people.robot`.
"""
