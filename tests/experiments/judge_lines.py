# Judges what a file has, a line for each case with its impacts.
import json, sys
sys.path.insert(0, sys.argv[1])
import judge
cases = {case['id']: case for scene in judge.load() for case in scene['cases']}
for line in open(sys.argv[2]):
    case, impacts = json.loads(line)
    print(judge.judge(cases[case], impacts))
