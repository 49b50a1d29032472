"""People at the keyboard, who teach in a study or play the robot.

What they see and type is here; as tutors they are `kille.studies.tutors.keyboard`, as
robots `kille.studies.robots.persons`.
"""
